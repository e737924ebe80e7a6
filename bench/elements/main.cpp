// SPDX-License-Identifier: GPL-3.0-or-later
// The study behind docs/elements.md: elements_study OUT_FOLDER writes CSV files that plot.py turns
// into figures and tables. Nothing random, times aside.
#include <fmt/format.h>
#include <fmt/os.h>

#include <cmath>
#include <filesystem>
#include <map>

#include "candidates.hpp"
#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/core/progress.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"
#include "infsup.hpp"
#include "reference.hpp"

extern "C" void openblas_set_num_threads(int) __attribute__((weak));

namespace hyperex::study {
namespace {

struct Steps {
  Progress bar{"comparing elements", 0};
  long done = 0;
  void step() { bar.update(++done); }
};

const double kPoisson[] = {0.3, 0.495, 0.4999};

std::vector<Candidate> candidates() {
  std::vector<Candidate> all{{"tet4", Candidate::plain},
                             {"stars, kept 0", Candidate::stars, 0},
                             {"stars, kept 2/3", Candidate::stars, 2.0 / 3},
                             {"stars, kept 2", Candidate::stars, 2},
                             {"stars, kept 10", Candidate::stars, 10},
                             {"disjoint stars, packed", Candidate::chosen},
                             {"disjoint stars, by number", Candidate::disjoint_stars}};
  for (const int size : {3, 4, 6, 8, 12, 24})
    all.push_back({fmt::format("patches of {}", size), Candidate::patches, 0, size});
  all.push_back({"patches of 8, kept 2", Candidate::patches, 2, 8});
  all.push_back({"P1-P1 projected", Candidate::stabilised_p1p1});
  all.push_back({"P2-P0", Candidate::quadratic});
  return all;
}

/// Root of the volume's mean of (p - exact)^2, over that of exact^2.
double pressure_error(const Problem& p, const Solution& s) {
  double off = 0, all = 0;
  for (Eigen::Index t = 0; t < p.tets.rows(); ++t) {
    const auto corner = fem::corners_of(p.nodes, p.tets, t);
    const double volume = fem::make_tet4(corner).volume;
    const double exact = p.pressure(corner.colwise().mean().transpose());
    off += volume * std::pow(s.pressure[t] - exact, 2);
    all += volume * exact * exact;
  }
  return std::sqrt(off / all);
}

/// How much the pressure jumps across inner faces, as a root mean square over that of the pressure:
/// shrinks with the elements where the pressure is smooth, and not where it is a checkerboard.
double pressure_jump(const Problem& p, const Solution& s) {
  std::map<std::array<int, 3>, int> open;
  double jump = 0, all = 0;
  int faces = 0;
  for (int t = 0; t < p.tets.rows(); ++t) {
    all += s.pressure[t] * s.pressure[t];
    for (int skip = 0; skip < 4; ++skip) {
      std::array<int, 3> face{p.tets(t, (skip + 1) % 4), p.tets(t, (skip + 2) % 4),
                              p.tets(t, (skip + 3) % 4)};
      std::sort(face.begin(), face.end());
      const auto [it, fresh] = open.try_emplace(face, t);
      if (fresh) continue;
      jump += std::pow(s.pressure[t] - s.pressure[it->second], 2);
      ++faces;
    }
  }
  return std::sqrt(jump / faces / (all / static_cast<double>(p.tets.rows())));
}

std::string times(const Solution& s) {
  return fmt::format("{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}", s.unknowns, s.assemble_s, s.analyse_s,
                     s.factor_s, s.solve_s, s.factor_entries);
}
const char* const kTimes = "unknowns,assemble_s,analyse_s,factor_s,solve_s,factor_entries";

/// P2-P0 stops a level earlier, as its unknowns are eight times as many.
void convergence(const std::filesystem::path& folder, Steps& progress) {
  auto out = fmt::output_file((folder / "convergence.csv").string());
  auto references = fmt::output_file((folder / "reference.csv").string());
  out.print("problem,poisson,candidate,level,error,pressure_error,pressure_jump,{}\n", kTimes);
  references.print("case,cells,rise\n");
  for (const int cells : {32, 64, 128})
    references.print("plane stress nu 1/3,{},{:.6f}\n", cells,
                     cooks_rise(cells, 1, 1.0 / 3, 1, true));
  for (const double nu : kPoisson) {
    double reference = 0;
    for (const int cells : {32, 64, 128}) {
      reference = cooks_rise(cells, 240.565, nu, 100, false);
      references.print("plane strain nu {},{},{:.6f}\n", nu, cells, reference);
    }
    std::vector<Problem> problems;
    for (const int n : {4, 8, 16, 32}) problems.push_back(cooks_membrane(n, nu, reference));
    for (const int n : {2, 4, 8, 16}) problems.push_back(bent_beam(n, nu));
    for (const int n : {3, 6, 9, 12}) problems.push_back(inflated_sphere(n, nu));
    for (const Problem& p : problems)
      for (const Candidate& c : candidates()) {
        const bool finest = p.level == 32 || (p.name == "beam" && p.level == 16) ||
                            (p.name == "sphere" && p.level == 12);
        if (c.family == Candidate::quadratic && finest) continue;
        const Solution s = solve(p, c, 3);
        out.print("{},{},\"{}\",{},{:.6g},{},{:.6g},{}\n", p.name, nu, c.name, p.level,
                  s.solved ? p.error(s.d) : NAN,
                  p.pressure && s.solved ? fmt::format("{:.6g}", pressure_error(p, s)) : "",
                  s.solved ? pressure_jump(p, s) : NAN, times(s));
        out.flush();
        progress.step();
      }
  }
}

/// Displacements of the surface of a pulled layer against those of a finer mesh.
void layer(const std::filesystem::path& folder, Steps& progress) {
  auto out = fmt::output_file((folder / "layer.csv").string());
  out.print("poisson,candidate,cells,levels,error,energy,reference_energy,pressure_jump,{}\n",
            kTimes);
  for (const double nu : kPoisson) {
    const Solution fine = solve(pulled_layer(40, 8, nu), {"", Candidate::quadratic});
    progress.step();
    const auto error = [&](const Solution& s, int cells) {
      double off = 0, all = 0;
      for (int j = 0; j <= cells; ++j)
        for (int i = 0; i <= cells; ++i) {
          const int step = 40 / cells;
          const Eigen::RowVector3d exact = fine.d.row(j * step * 41 + i * step);
          off += (s.d.row(j * (cells + 1) + i) - exact).squaredNorm();
          all += exact.squaredNorm();
        }
      return std::sqrt(off / all);
    };
    for (const auto& [cells, levels] : {std::pair{20, 2}, {20, 4}, {40, 4}})
      for (const Candidate& c : candidates()) {
        if (c.family == Candidate::quadratic && cells == 40) continue;
        const Problem p = pulled_layer(cells, levels, nu);
        const Solution s = solve(p, c, 3);
        out.print("{},\"{}\",{},{},{:.6g},{:.6g},{:.6g},{:.6g},{}\n", nu, c.name, cells, levels,
                  error(s, cells), s.energy, fine.energy, pressure_jump(p, s), times(s));
        out.flush();
        progress.step();
      }
  }
}

/// What each candidate costs on the face that comes with the program; the inner surface held.
void face(const std::filesystem::path& folder, Steps& progress) {
  const auto embedded = anatomy::embedded_face();
  const auto mesh = tissue::build_tissue_mesh(embedded.mesh, embedded.landmarks, {}, "embedded");
  auto out = fmt::output_file((folder / "face.csv").string());
  out.print("candidate,nodes,tets,{}\n", kTimes);
  Problem p;
  p.young = 192.4e3;
  p.poisson = 0.495;
  p.nodes = mesh.volume.nodes;
  p.tets = mesh.volume.tets;
  const double held_until =
      mesh.volume.nodes.bottomRows(mesh.volume.surface_nodes()).col(2).minCoeff();
  const double band = held_until + 0.01;
  p.support = [band](const Vec3& x) {
    std::array<std::optional<double>, 3> held;
    if (x[2] < band) held = {0.0, 0.0, 0.0};
    return held;
  };
  for (const Candidate& c : candidates()) {
    const Solution s = solve(p, c, c.family == Candidate::quadratic ? 1 : 5);
    out.print("\"{}\",{},{},{}\n", c.name, p.nodes.rows(), p.tets.rows(), times(s));
    out.flush();
    progress.step();
  }
}

void stability(const std::filesystem::path& folder, Steps& progress) {
  auto out = fmt::output_file((folder / "infsup.csv").string());
  out.print("candidate,mesh,cells,groups,spurious,constant\n");
  for (const Candidate& c : candidates()) {
    if (c.kept > 0 || c.family >= Candidate::stabilised_p1p1) continue;
    for (const int cells : {3, 4, 6, 8}) {
      if (c.family == Candidate::plain && cells > 4) continue;  // dense eigenvalues
      if (cells == 8 && c.family == Candidate::patches && c.size < 4) continue;
      for (const Problem& cube : {unit_cube(cells), irregular_cube(cells)}) {
        const InfSup i = inf_sup(c, cube);
        out.print("\"{}\",{},{},{},{},{:.6g}\n", c.name, cube.name, cells, i.groups, i.spurious,
                  i.constant);
      }
      out.flush();
      progress.step();
    }
  }
}

/// Pressures of the front of Cook's membrane, triangle by triangle.
void picture(const std::filesystem::path& folder) {
  const Problem p = cooks_membrane(16, 0.4999, 1);
  auto out = fmt::output_file((folder / "cook_pressure.csv").string());
  out.print("candidate,x0,y0,x1,y1,x2,y2,pressure\n");
  for (const Candidate& c : candidates()) {
    const Solution s = solve(p, c);
    for (Eigen::Index t = 0; t < p.tets.rows(); ++t) {
      std::string front;
      int count = 0;
      for (int a = 0; a < 4; ++a)
        if (const auto x = p.nodes.row(p.tets(t, a)); x[2] < 1e-9) {
          front += fmt::format("{:.5g},{:.5g},", x[0], x[1]);
          ++count;
        }
      if (count == 3) out.print("\"{}\",{}{:.6g}\n", c.name, front, s.pressure[t]);
    }
  }
}

}  // namespace
}  // namespace hyperex::study

int main(int argc, char** argv) {
  using namespace hyperex;
  if (argc < 2) {
    fmt::print(stderr, "usage: elements_study FOLDER [face|layer|convergence|stability|picture]\n");
    return 2;
  }
  if (openblas_set_num_threads) openblas_set_num_threads(1);
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  const std::string only = argc > 2 ? argv[2] : "";
  study::Steps progress;
  if (only.empty() || only == "face") study::face(folder, progress);
  if (only.empty() || only == "layer") study::layer(folder, progress);
  if (only.empty() || only == "picture") study::picture(folder);
  if (only.empty() || only == "convergence") study::convergence(folder, progress);
  if (only.empty() || only == "stability") study::stability(folder, progress);
}
