// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/calculix.hpp"

#include <fmt/format.h>
#include <fmt/os.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "hyperex/core/assert.hpp"
#include "hyperex/core/error.hpp"
#include "support/test_file.hpp"

namespace hyperex::test {

namespace fs = std::filesystem;
using SparseMatrix = Eigen::SparseMatrix<double>;

namespace {

/// ccx reads at most 20 characters of a number.
std::string number(double x) {
  std::string text = fmt::format("{:.16g}", x);
  for (int digits = 15; text.size() > 20; --digits) text = fmt::format("{:.{}g}", x, digits);
  return text;
}

void write_mesh(fmt::ostream& out, const CalculixModel& model) {
  out.print("*NODE,NSET=NALL\n");
  for (Eigen::Index n = 0; n < model.nodes.rows(); ++n)
    out.print("{},{},{},{}\n", n + 1, number(model.nodes(n, 0)), number(model.nodes(n, 1)),
              number(model.nodes(n, 2)));
  out.print("*ELEMENT,TYPE=C3D4,ELSET=EALL\n");
  for (Eigen::Index t = 0; t < model.tets.rows(); ++t)
    out.print("{},{},{},{},{}\n", t + 1, model.tets(t, 0) + 1, model.tets(t, 1) + 1,
              model.tets(t, 2) + 1, model.tets(t, 3) + 1);
  out.print("*MATERIAL,NAME=TISSUE\n");
  if (model.hyperelastic) {
    const CalculixHyperelastic& h = *model.hyperelastic;
    const std::string d1 = number(2 / h.bulk_pa);  // U = (J - 1)^2 / D1 + ...
    if (h.c20_pa == 0 && h.c30_pa == 0)
      out.print("*HYPERELASTIC,NEO HOOKE\n{},{}\n", number(h.c10_pa), d1);
    else
      out.print("*HYPERELASTIC,YEOH\n{},{},{},{},1e20,1e20\n", number(h.c10_pa), number(h.c20_pa),
                number(h.c30_pa), d1);
    out.print("*SOLID SECTION,ELSET=EALL,MATERIAL=TISSUE\n");
    return;
  }
  out.print("*ELASTIC\n{},{}\n*DENSITY\n{}\n", number(model.young_pa), number(model.poisson),
            number(model.density_kg_m3));
  out.print("*DAMPING,ALPHA={},BETA={}\n*SOLID SECTION,ELSET=EALL,MATERIAL=TISSUE\n",
            number(model.alpha_per_s), number(model.beta_s));
}

void write_motion(fmt::ostream& out, const CalculixModel& model, double gain) {
  const Eigen::Index steps = model.motion_m.rows();
  out.print("*BOUNDARY\n");
  for (const int n : model.held_nodes) out.print("{},1,3\n", n + 1);
  for (Eigen::Index j = 0; j < model.motion_m.cols(); ++j) {
    out.print("*AMPLITUDE,NAME=A{}\n0,0\n", j);
    for (Eigen::Index i = 0; i < steps; ++i)
      out.print("{},{}\n", number((i + 1) * model.dt_s), number(gain * model.motion_m(i, j)));
  }
  if (model.hyperelastic)
    out.print(
        "*STEP,INC={},NLGEOM\n*STATIC,DIRECT,SOLVER=SPOOLES\n{},{}\n"
        "*CONTROLS,PARAMETERS=FIELD\n1e-8,1e-8,,,1e-8\n",
        2 * steps + 10, number(model.dt_s), number(steps * model.dt_s));
  else
    out.print("*STEP,INC={}\n*DYNAMIC,DIRECT,ALPHA=0,SOLVER=SPOOLES\n{},{}\n", 2 * steps + 10,
              number(model.dt_s), number(steps * model.dt_s));
  for (std::size_t j = 0; j < model.driven.size(); ++j)
    out.print("*BOUNDARY,AMPLITUDE=A{0}\n{1},{2},{2},1\n", j, model.driven[j] / 3 + 1,
              model.driven[j] % 3 + 1);
  out.print("*NODE PRINT,NSET=NALL\nU\n*END STEP\n");
}

std::string last_lines(const fs::path& file) {
  std::ifstream in(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);)
    if (!line.empty()) lines.push_back(line);
  std::string text;
  for (std::size_t i = lines.size() > 12 ? lines.size() - 12 : 0; i < lines.size(); ++i)
    text += "\n  " + lines[i];
  return text;
}

/// One block per step: a headline with the word "displacements", then lines "node x y z".
std::vector<Eigen::VectorXd> read_displacements(const fs::path& file, Eigen::Index nodes) {
  std::vector<Eigen::VectorXd> steps;
  std::vector<Eigen::Index> rows;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (line.find("displacements") != std::string::npos) {
      steps.push_back(Eigen::VectorXd::Constant(3 * nodes, NAN));
      rows.push_back(0);
      continue;
    }
    char* at = line.data();
    const long node = std::strtol(at, &at, 10);
    if (node < 1 || node > nodes || steps.empty()) continue;
    for (int axis = 0; axis < 3; ++axis) steps.back()[3 * (node - 1) + axis] = std::strtod(at, &at);
    ++rows.back();
  }
  for (std::size_t i = 0; i < steps.size(); ++i)
    if (rows[i] != nodes || !steps[i].allFinite())
      throw NumericalError(
          fmt::format("CalculiX wrote {} of {} nodes at step {}", rows[i], nodes, i + 1));
  return steps;
}

}  // namespace

std::optional<fs::path> find_calculix() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (const fs::path ccx = fs::path(folder) / "ccx"; access(ccx.c_str(), X_OK) == 0) return ccx;
  return std::nullopt;
}

double calculix_gain(double greatest) {
  return 0.99 * std::pow(10, std::ceil(std::log10(greatest))) / greatest;
}

CalculixRun run_calculix(const CalculixModel& model, double gain, int threads) {
  HX_ASSERT(gain == 1 || !model.hyperelastic);
  const auto ccx = find_calculix();
  if (!ccx) throw NumericalError("ccx is not on the PATH");
  const TestFolder scratch;
  {
    auto out = fmt::output_file((scratch / "job.inp").string());
    write_mesh(out, model);
    write_motion(out, model, gain);
  }
  const std::string command =
      fmt::format("cd '{}' && OMP_NUM_THREADS={} OPENBLAS_NUM_THREADS=1 '{}' -i job > log 2>&1",
                  scratch.path().string(), threads, ccx->string());
  CalculixRun run;
  const auto start = std::chrono::steady_clock::now();
  const int code = std::system(command.c_str());
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (code == 0) run.displacement_m = read_displacements(scratch / "job.dat", model.nodes.rows());
  if (static_cast<Eigen::Index>(run.displacement_m.size()) != model.motion_m.rows())
    throw NumericalError(fmt::format("CalculiX ended with {} after {} of {} steps:{}", code,
                                     run.displacement_m.size(), model.motion_m.rows(),
                                     last_lines(scratch / "log")));
  for (Eigen::VectorXd& d : run.displacement_m) d /= gain;
  return run;
}

namespace {

/// The rows of the free unknowns and some columns of a matrix.
SparseMatrix part(const SparseMatrix& m, const std::vector<int>& free_index,
                  const std::vector<int>& columns, int rows) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t c = 0; c < columns.size(); ++c)
    for (SparseMatrix::InnerIterator it(m, columns[c]); it; ++it)
      if (free_index[it.row()] >= 0)
        entries.emplace_back(free_index[it.row()], static_cast<int>(c), it.value());
  SparseMatrix result(rows, static_cast<Eigen::Index>(columns.size()));
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

struct State {
  Eigen::VectorXd d, v, a;
  explicit State(Eigen::Index n) { d = v = a = Eigen::VectorXd::Zero(n); }
  /// Newmark's formulas.
  void move(const Eigen::VectorXd& next, double dt) {
    const Eigen::VectorXd change = next - d;
    a = 4 / (dt * dt) * change - 4 / dt * v - a;
    v = 2 / dt * change - v;
    d = next;
  }
};

}  // namespace

History integrate(const DrivenTerms& terms, const CalculixModel& model) {
  const auto n = static_cast<int>(3 * model.nodes.rows());
  std::vector<int> free_index(n, 0), free;
  for (const int u : model.driven) free_index[u] = -1;
  for (const int node : model.held_nodes)
    for (int axis = 0; axis < 3; ++axis) free_index[3 * node + axis] = -1;
  for (int u = 0; u < n; ++u)
    if (free_index[u] == 0) {
      free_index[u] = static_cast<int>(free.size());
      free.push_back(u);
    }
  const auto rows = static_cast<int>(free.size());
  const auto among_free = [&](const SparseMatrix& m) { return part(m, free_index, free, rows); };
  const auto of_driven = [&](const SparseMatrix& m) {
    return part(m, free_index, model.driven, rows);
  };

  const double dt = model.dt_s;
  const SparseMatrix c_oo = among_free(terms.damping), m_oo = among_free(terms.mass);
  const SparseMatrix k_oc = of_driven(terms.stiffness), c_oc = of_driven(terms.damping),
                     m_oc = of_driven(terms.mass);
  const SparseMatrix a_oo = among_free(terms.stiffness) + 2 / dt * c_oo + 4 / (dt * dt) * m_oo;
  const Eigen::SimplicialLLT<SparseMatrix> factor(a_oo);
  if (factor.info() != Eigen::Success) throw NumericalError("imitation: not positive definite");

  State o(rows), c(model.motion_m.cols());
  History history;
  for (Eigen::Index i = 0; i < model.motion_m.rows(); ++i) {
    c.move(model.motion_m.row(i).transpose(), dt);
    Eigen::VectorXd right = m_oo * (4 / (dt * dt) * o.d + 4 / dt * o.v + o.a) +
                            c_oo * (2 / dt * o.d + o.v) - k_oc * c.d;
    if (terms.damping_of_driven) right -= c_oc * c.v;
    if (terms.inertia_of_driven) right -= m_oc * c.a;
    o.move(factor.solve(right), dt);
    history.push_back(Eigen::VectorXd::Zero(n));
    history.back()(free) = o.d;
    history.back()(model.driven) = c.d;
  }
  return history;
}

SparseMatrix one_point_mass(const CalculixModel& model, double diagonal, double other) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index t = 0; t < model.tets.rows(); ++t) {
    const auto at = [&](int a) -> Vec3 { return model.nodes.row(model.tets(t, a)).transpose(); };
    const double volume = (at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)) / 6;
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b)
        for (int axis = 0; axis < 3; ++axis)
          entries.emplace_back(3 * model.tets(t, a) + axis, 3 * model.tets(t, b) + axis,
                               model.density_kg_m3 * volume * (a == b ? diagonal : other));
  }
  SparseMatrix mass(3 * model.nodes.rows(), 3 * model.nodes.rows());
  mass.setFromTriplets(entries.begin(), entries.end());
  return mass;
}

double greatest(const History& a) {
  double most = 0;
  for (const Eigen::VectorXd& d : a) most = std::max(most, d.cwiseAbs().maxCoeff());
  return most;
}

double difference(const History& a, const History& b) {
  if (a.size() != b.size()) throw NumericalError("histories of different length");
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    most = std::max(most, (a[i] - b[i]).cwiseAbs().maxCoeff());
  return most / greatest(a);
}

}  // namespace hyperex::test
