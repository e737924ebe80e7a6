// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/estimate/proposal.hpp"

#include "hyperex/estimate/intervals.hpp"
#include "hyperex/estimate/standard_expressions.hpp"

namespace hyperex::estimate {

std::vector<Proposal> proposals(FaceModel& face, const Posterior& posterior, const Mode& mode,
                                const Assumptions& assumptions) {
  std::vector<Observation> seen = posterior.observations();
  seen.push_back(seen.front());
  seen.back().load = -1;
  const Posterior with(face, seen, assumptions);
  std::vector<int> loads(seen.size(), -1);  // only the last is used
  RecordingModel model(face, with.unknowns(), loads);
  const Unknowns& u = with.unknowns();
  const Eigen::Index before = mode.x.size(), added = u.each(), last = u.recordings - 1;
  std::vector<Proposal> out;
  for (const StandardExpression& expression : standard_expressions()) {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(u.all());
    x.head(before) = mode.x;
    x.segment(u.activations(last), u.muscles) = activations_of(expression, face.responses.lines());
    x[u.jaw(last)] = expression.opening_rad;
    seen.back().displacement_m = model.displacement(x, last);
    Mode both;
    both.x = x;
    both.hessian = with.information(model.derivative(x, last), seen.back(), mode.error_scale);
    both.hessian.topLeftCorner(before, before) += mode.hessian;
    both.hessian.bottomRightCorner(added, added) +=
        with.prior_precision(x).bottomRightCorner(added, added);
    both.fixed = mode.fixed;
    both.fixed.resize(std::size_t(u.all()), false);
    out.push_back({expression.name, asked_covariance(both, u).diagonal().cwiseSqrt()});
  }
  return out;
}

}  // namespace hyperex::estimate
