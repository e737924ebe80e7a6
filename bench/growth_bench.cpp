// SPDX-License-Identifier: GPL-3.0-or-later
// One size of the embedded face: time and peak memory of each stage, from the mesh to the basis.
// Each size needs its own process, so that the peak memory of one does not affect another.
#include <fmt/format.h>
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <optional>

#include "hyperex/fem/reduced/reduced_model.hpp"
#include "support/face_case.hpp"
#include "support/machine.hpp"
#include "support/timing.hpp"

namespace hyperex::bench {
namespace {

using Json = nlohmann::ordered_json;

struct Request {
  MeshSize size;
  std::string element = "tet4-star", file = "-";
  int steps = 10;
  double memory_gib = 20;
};

fem::ElementKind kind_of(const std::string& name) {
  for (const fem::ElementKind kind : fem::kElementKinds)
    if (to_string(kind) == name) return kind;
  throw CLI::ValidationError("--element", name);
}

/// Measures the time of each stage, and its memory beyond what is in use already.
class Stages {
 public:
  explicit Stages(Json& out, std::string file) : out_(out), file_(std::move(file)) {}
  template <class Work>
  auto operator()(const char* name, Work work) {
    out_["stopped_at"] = name;
    if (file_ != "-") write_json(out_, file_);  // save the results so far, in case this stage fails
    reset_peak_memory();
    Stopwatch watch;
    auto result = work();
    out_["stages"][name] = {{"seconds", watch.lap()}, {"peak_bytes", peak_memory()}};
    out_.erase("stopped_at");
    return result;
  }

 private:
  Json& out_;
  std::string file_;
};

/// Runs a full model for `steps` steps; returns seconds per step.
double steps_of(fem::Newmark& newmark, const fem::Drive& drive, int steps) {
  std::vector<double> s;
  for (int step = 1; step <= steps; ++step)
    s.push_back(seconds_of([&] { newmark.step(drive.prescribed_at(step), drive.force_at(step)); }));
  return median(s);
}

void measure(const Request& request, Json& out) {
  Stages stage(out, request.file);
  out["element"] = request.element;
  const fem::ElementKind kind = kind_of(request.element);
  const FaceCase face = stage("mesh", [&] { return FaceCase(Face::embedded, request.size); });
  // Reading the scan and making the boundary do not belong to the mesh.
  out["stages"]["mesh"]["seconds"] = face.mesh_seconds();
  const auto& volume = face.mesh().volume;
  out["nodes"] = volume.nodes.rows();
  out["tets"] = volume.tets.rows();
  const auto assemble = [&] {
    const fem::Assembler assembler(volume.nodes, volume.tets, kind);
    fem::System s;
    face.assemble(assembler, face.material(), s);
    return s;
  };
  fem::System system = stage("assemble", assemble);
  const fem::Drive drive = face.drive(1e-3);
  {
    fem::Newmark newmark = stage("factor", [&] {
      return fem::Newmark(std::move(system), face.prescribed(), fem::NewmarkOptions{face.dt_s()});
    });
    out["free_unknowns"] = newmark.free_count();
    out["analyse_s"] = newmark.analyse_seconds();
    out["factor_s"] = newmark.factor_seconds();
    out["factor_bytes"] = 8 * newmark.factor_entries();
    const double step_s = stage("step", [&] { return steps_of(newmark, drive, request.steps); });
    out["stages"]["step"]["seconds"] = step_s;
  }
  system = assemble();
  fem::ReducedModel model = stage(
      "reduced factor", [&] { return fem::ReducedModel(std::move(system), face.prescribed()); });
  out["reduced_factor_bytes"] = 8 * model.factor_entries();
  fem::ReducedOptions options;
  options.time.dt_s = face.dt_s();
  const fem::Response response = stage("basis", [&] { return model.run(drive, options); });
  out["basis_size"] = response.basis_size;
  out["estimated_error"] = response.estimated_error;
}

/// Returns 0, or 1 where a stage failed; the file contains the results of the stages before.
int run(const Request& request) {
  const auto bytes = static_cast<rlim_t>(request.memory_gib * (1 << 30));
  const rlimit limit{bytes, bytes};
  setrlimit(RLIMIT_AS, &limit);
  Json out;
  try {
    measure(request, out);
  } catch (const std::exception& e) {
    out["failed"] = e.what();
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  double peak = 1024.0 * static_cast<double>(usage.ru_maxrss);
  for (const auto& s : out["stages"]) peak = std::max(peak, s["peak_bytes"].get<double>());
  out["peak_bytes"] = peak;
  write_json(out, request.file);
  return out.contains("failed") ? 1 : 0;
}

}  // namespace
}  // namespace hyperex::bench

int main(int argc, char** argv) {
  hyperex::bench::Request request;
  CLI::App app("One size of the growth table");
  app.add_option("--size", request.size.element_size_m, "of elements at the mouth (m)");
  app.add_option("--layers", request.size.layers, "of elements");
  app.add_option("--element", request.element, "kind of element");
  app.add_option("--steps", request.steps, "of the full model");
  app.add_option("--memory", request.memory_gib, "limit of the address space (GiB)");
  app.add_option("--out", request.file, "file to write");
  CLI11_PARSE(app, argc, argv);
  return hyperex::bench::run(request);
}
