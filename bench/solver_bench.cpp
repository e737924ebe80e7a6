// SPDX-License-Identifier: GPL-3.0-or-later
// The full model: times of factorisation and of the parts of a step, compared with the rate at
// which memory can be read; orderings, number types and several right-hand sides; CalculiX on the
// same mesh.
#include <cholmod.h>
#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <ctime>
#include <map>

#include "hyperex/fem/solve/partitioned_factor.hpp"
#include "hyperex/fem/solve/triangular.hpp"
#include "hyperex/fem/time/inertia.hpp"
#include "support/calculix.hpp"
#include "support/face_case.hpp"
#include "support/machine.hpp"
#include "support/own_cholmod.hpp"
#include "support/timing.hpp"
#include "support/tree_kernel.hpp"

namespace hyperex::bench {
namespace {

using Json = nlohmann::ordered_json;
using Threads = tbb::global_control;
constexpr auto kThreads = Threads::max_allowed_parallelism;

struct Effort {
  int repeats, ccx_few, ccx_many;
};

/// The matrix A of Newmark's method with average acceleration, as fem::Newmark factors it.
fem::SparseMatrix step_matrix(const fem::System& system, double h) {
  return fem::combined(system, 2 / h, 4 / (h * h));
}

struct StepTimes {
  double step_s;      ///< median
  double cores_busy;  ///< processor time divided by elapsed time: the mean number of busy threads
};

/// Every step of the motion, timed one by one.
StepTimes step_times(const FaceCase& face, fem::Newmark& newmark, const fem::Drive& drive) {
  const auto& prescribed = face.prescribed();
  fem::Kinematics next = drive.prescribed_at(0);
  Eigen::VectorXd force = drive.force_at(0);
  Eigen::VectorXd d = Eigen::VectorXd::Zero(3 * face.mesh().volume.nodes.rows()), v = d;
  d(prescribed) = next.d;
  v(prescribed) = next.v;
  newmark.start(d, v, next.a, force);
  std::vector<double> s;
  Stopwatch watch, all;
  const std::clock_t cpu = std::clock();
  for (int step = 1; step <= drive.steps(); ++step) {
    watch.lap();
    next.d.noalias() = drive.prescribed * drive.s.col(step);
    next.v.noalias() = drive.prescribed * drive.rate.col(step);
    next.a.noalias() = drive.prescribed * drive.second.col(step);
    force.noalias() = drive.force * drive.s.col(step);
    newmark.step(next, force);
    s.push_back(watch.lap());
  }
  const double cpu_s = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
  return {median(s), cpu_s / all.lap()};
}

/// Times the parts of a step in their order in the step, so that the caches are in the same state.
Json step_parts(const fem::System& system, fem::PartitionedFactor& factor, int repeats) {
  const fem::InertiaRows inertia(system);
  const fem::SparseMatrix coupling = fem::coupling(system.stiffness, factor.partition());
  const Eigen::VectorXd u = Eigen::VectorXd::Random(system.stiffness.cols());
  const Eigen::VectorXd d_c = Eigen::VectorXd::Random(coupling.cols());
  Eigen::VectorXd q = u, x = u(factor.free());
  std::vector<double> product_s, coupling_s, solve_s;
  Stopwatch watch;
  for (int i = 0; i < repeats; ++i) {
    watch.lap();
    inertia.product(u, u, q);
    product_s.push_back(watch.lap());
    x.noalias() -= coupling * d_c;
    coupling_s.push_back(watch.lap());
    factor.solve(x);
    solve_s.push_back(watch.lap());
    x = x.normalized();
  }
  // InertiaRows stores nine damping values, a mass and an index for each pair of nodes.
  return {{"product_s", median(product_s)},
          {"product_bytes", static_cast<double>(system.mass.nonZeros()) / 9 * 88},
          {"coupling_s", median(coupling_s)},
          {"solve_s", median(solve_s)}};
}

Json full_model(const FaceCase& face, const fem::System& system, const fem::Drive& drive,
                const Effort& effort) {
  Json out;
  fem::Newmark newmark(system, face.prescribed(), {face.dt_s()});
  out["free_unknowns"] = newmark.free_count();
  out["analyse_s"] = newmark.analyse_seconds();
  const fem::SparseMatrix a = step_matrix(system, face.dt_s());
  fem::PartitionedFactor factor(a, face.prescribed(), "benchmark");
  std::vector<double> refactor_s;
  for (int i = 0; i < 5; ++i) {
    factor.refactor(a);
    refactor_s.push_back(factor.factor_seconds());
  }
  out["refactor_s"] = median(refactor_s);
  out["refill_s"] = median_seconds(3, [&] { newmark.refill(system); });
  const double entries = newmark.factor_entries();
  out["entries"] = entries;
  out["bytes"] = 8 * entries;
  out["flops"] = factor.cholesky().flops();
  for (const int threads : {1, 2}) {
    if (threads > cores()) break;
    const Threads limit(kThreads, static_cast<std::size_t>(threads));
    const StepTimes times = step_times(face, newmark, drive);
    Json t{{"threads", threads}, {"step_s", times.step_s}, {"cores_busy", times.cores_busy}};
    t.update(step_parts(system, factor, effort.repeats));
    // The read rate of an array as large as the factor. It gives a lower bound on the time of every
    // solver that reads L twice, where memory limits the speed.
    t["read_like_factor"] = read_rate(static_cast<std::size_t>(8 * entries), threads);
    out["steps"].push_back(t);
  }
  for (const int columns : {1, 4, 16, 32}) {
    Eigen::MatrixXd b = Eigen::MatrixXd::Random(newmark.free_count(), columns);
    const double s = median_seconds(std::max(5, effort.repeats / 4 / columns), [&] {
      factor.solve(b);
      b.colwise().normalize();
    });
    out["several"].push_back({{"columns", columns}, {"solve_s", s}});
  }
  return out;
}

/// Compares orderings, each solved by CHOLMOD and by the library's kernel.
Json orderings(const fem::SparseMatrix& lower, int repeats) {
  Json out = Json::array();
  for (const auto& [name, ordering] :
       std::map<std::string, int>{{"AMD", CHOLMOD_AMD}, {"METIS", CHOLMOD_METIS}}) {
    OwnCholmod cholmod(lower, ordering);
    const Eigen::MatrixXd b = Eigen::MatrixXd::Random(lower.cols(), 1);
    fem::TriangularSolver own(cholmod.supernodes());
    Eigen::VectorXd y = b.col(0);
    std::vector<double> own_s, cholmod_s;
    Stopwatch watch;
    for (int i = 0; i < repeats; ++i) {
      watch.lap();
      own.solve(cholmod.supernodes(), y.data());
      own_s.push_back(watch.lap());
      cholmod.solve(b);
      cholmod_s.push_back(watch.lap());
      y.normalize();
    }
    out.push_back({{"ordering", name},
                   {"analyse_s", cholmod.analyse_seconds()},
                   {"factor_s", cholmod.factor_seconds()},
                   {"entries", cholmod.entries()},
                   {"own_solve_s", median(own_s)},
                   {"cholmod_solve_s", median(cholmod_s)}});
  }
  return out;
}

/// Product of a symmetric matrix, both triangles stored, and a vector; the rows are divided among
/// the threads.
void multiply(const fem::SparseMatrix& a, const Eigen::VectorXd& x, Eigen::VectorXd& out) {
  tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, a.cols(), 512), [&](const auto& range) {
    for (Eigen::Index i = range.begin(); i < range.end(); ++i) {
      double sum = 0;
      for (fem::SparseMatrix::InnerIterator it(a, i); it; ++it) sum += it.value() * x[it.row()];
      out[i] = sum;
    }
  });
}

/// Solves x = A^-1 b with a copy of the factor in T: once, with one step of iterative refinement,
/// or only for the change from a guess.
template <class T>
class Refined {
 public:
  Refined(const OwnCholmod& factor, const fem::SparseMatrix& a)
      : kernel_(factor.supernodes()),
        permutation_(factor.permutation()),
        a_(a),
        y_(a.cols()),
        rest_(a.cols()) {}

  double bytes() const { return kernel_.bytes(); }
  void solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) {
    x.setZero();
    add(b, x);
  }
  void correct(const Eigen::VectorXd& b, Eigen::VectorXd& x) {
    multiply(a_, x, rest_);
    rest_ = b - rest_;
    add(rest_, x);
  }

 private:
  void add(const Eigen::VectorXd& b, Eigen::VectorXd& x) {
    for (Eigen::Index i = 0; i < b.size(); ++i) y_[i] = static_cast<T>(b[permutation_[i]]);
    kernel_.solve(y_);
    for (Eigen::Index i = 0; i < b.size(); ++i) x[permutation_[i]] += static_cast<double>(y_[i]);
  }

  TreeKernel<T> kernel_;
  const int* permutation_;
  const fem::SparseMatrix& a_;
  typename TreeKernel<T>::Vector y_;
  Eigen::VectorXd rest_;
};

/// Steps of the real motion to be solved again: right-hand side, prediction from the previous state
/// (d + h v + h^2/2 a), and solution.
struct Solved {
  Eigen::VectorXd b, guess, x;
};

std::vector<Solved> solved_steps(const FaceCase& face, const fem::System& system,
                                 const fem::Drive& drive, const fem::SparseMatrix& a_oo,
                                 const std::vector<int>& free) {
  fem::Newmark newmark(system, face.prescribed(), {face.dt_s()});
  const double h = face.dt_s();
  std::vector<Solved> out;
  for (int step = 1; step <= drive.steps(); ++step) {
    const fem::Kinematics before = newmark.state();
    newmark.step(drive.prescribed_at(step), drive.force_at(step));
    if (step % std::max(1, drive.steps() / 12) != 0) continue;
    const Eigen::VectorXd expected = before.d + h * before.v + h * h / 2 * before.a;
    Solved s{{}, expected(free), newmark.displacement()(free)};
    s.b = a_oo * s.x;
    out.push_back(std::move(s));
  }
  return out;
}

Json number_types(const FaceCase& face, const fem::System& system, const fem::Drive& drive,
                  int repeats) {
  const fem::SparseMatrix a = step_matrix(system, face.dt_s());
  const fem::Partition partition(static_cast<int>(a.cols()), face.prescribed());
  const fem::SparseMatrix lower = fem::free_lower(a, partition);
  const fem::SparseMatrix a_oo = lower.selfadjointView<Eigen::Lower>();
  const auto steps = solved_steps(face, system, drive, a_oo, partition.free);
  double greatest = 0;
  for (const Solved& s : steps) greatest = std::max(greatest, s.x.lpNorm<Eigen::Infinity>());

  const OwnCholmod factor(lower, CHOLMOD_METIS);
  Refined<double> in_double(factor, a_oo);
  Refined<float> in_float(factor, a_oo);
  Eigen::VectorXd x(lower.cols());
  Json out = Json::array();
  const auto measure = [&](const char* name, double bytes, auto solve) {
    double off = 0;
    for (const Solved& s : steps) {
      solve(s);
      off = std::max(off, (x - s.x).lpNorm<Eigen::Infinity>());
    }
    std::size_t i = 0;
    const double s = median_seconds(repeats, [&] { solve(steps[i++ % steps.size()]); });
    out.push_back({{"name", name}, {"seconds", s}, {"bytes", bytes}, {"error", off / greatest}});
  };
  const double of_a = 12.0 * static_cast<double>(a_oo.nonZeros());
  const double of_double = 2 * in_double.bytes(), of_float = 2 * in_float.bytes();
  measure("double", of_double, [&](const Solved& s) { in_double.solve(s.b, x); });
  measure("float", of_float, [&](const Solved& s) { in_float.solve(s.b, x); });
  measure("float, refined once", 2 * of_float + of_a, [&](const Solved& s) {
    in_float.solve(s.b, x);
    in_float.correct(s.b, x);
  });
  measure("float, the change since the expected alone", of_float + of_a, [&](const Solved& s) {
    x = s.guess;
    in_float.correct(s.b, x);
  });
  return out;
}

/// The same mesh, driven nodes and time step in CalculiX, held at the fixed nodes, with Rayleigh
/// damping. The springs of bones and foundation, which would hardly cost time, are left out.
Json calculix(const FaceCase& face, const fem::Drive& drive, const Effort& effort) {
  if (!test::find_calculix()) return nullptr;
  test::CalculixModel model;
  model.nodes = face.mesh().volume.nodes;
  model.tets = face.mesh().volume.tets;
  model.young_pa = face.tissue().uniform[tissue::young];
  model.poisson = face.tissue().uniform[tissue::poisson];
  model.density_kg_m3 = face.tissue().uniform[tissue::density];
  model.beta_s = face.tissue().uniform[tissue::viscosity] /
                 fem::shear_modulus_pa(model.young_pa, model.poisson);
  model.held_nodes = face.boundary().held_nodes();
  model.dt_s = face.dt_s();
  const auto& nodes = face.boundary().driven_nodes();
  std::vector<int> rows;
  for (std::size_t i = 0; i < face.prescribed().size(); ++i)
    if (std::count(nodes.begin(), nodes.end(), face.prescribed()[i] / 3)) {
      rows.push_back(static_cast<int>(i));
      model.driven.push_back(face.prescribed()[i]);
    }
  std::vector<double> s;
  for (const int steps : {effort.ccx_few, effort.ccx_many}) {
    model.motion_m =
        (drive.prescribed(rows, Eigen::all) * drive.s.middleCols(1, steps)).transpose();
    s.push_back(test::run_calculix(model, 1, 2).seconds);
  }
  return {{"few", effort.ccx_few},
          {"many", effort.ccx_many},
          {"few_s", s[0]},
          {"many_s", s[1]},
          {"step_s", (s[1] - s[0]) / (effort.ccx_many - effort.ccx_few)}};
}

Json measure(const Effort& effort, bool quick) {
  Json out;
  out["machine"] = describe_machine();
  const FaceCase face(Face::subject_a_if_there);
  const fem::Drive drive = face.drive(1e-3, quick ? 200 : 0);
  out["case"] = {{"name", face.name()},
                 {"nodes", face.mesh().volume.nodes.rows()},
                 {"tets", face.mesh().volume.tets.rows()},
                 {"steps", drive.steps()},
                 {"dt_s", face.dt_s()},
                 {"input_shapes", drive.shapes()}};
  for (const fem::ElementKind kind : fem::kElementKinds) {
    const fem::System system = face.system(kind);
    Json element = full_model(face, system, drive, effort);
    const fem::SparseMatrix a = step_matrix(system, face.dt_s());
    const fem::Partition partition(static_cast<int>(a.cols()), face.prescribed());
    element["orderings"] = orderings(fem::free_lower(a, partition), effort.repeats);
    element["number_types"] = number_types(face, system, drive, effort.repeats);
    out["elements"][std::string(to_string(kind))] = element;
  }
  out["calculix"] = calculix(face, drive, effort);
  return out;
}

}  // namespace
}  // namespace hyperex::bench

/// solver_bench FILE.json [--quick]
int main(int argc, char** argv) {
  using namespace hyperex::bench;
  const bool quick = argc > 2 && std::string(argv[2]) == "--quick";
  write_json(measure(quick ? Effort{60, 2, 5} : Effort{300, 2, 20}, quick),
             argc > 1 ? argv[1] : "-");
}
