// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/run/finite_contact.hpp"

#include <algorithm>
#include <utility>

#include "hyperex/core/error.hpp"

namespace hyperex::simulate {
namespace {

constexpr int kMostFiniteRounds = 20;
constexpr int kMostIdleRounds = 3;    // in a row that gain little
constexpr double kGainsLittle = 0.9;  // depth over the least one before
constexpr double kFiniteSettled_m = 2e-5;

}  // namespace

FiniteContact::FiniteContact(const MouthContact& contact, FiniteCorrection& tissue,
                             const ContactFrames& frames, SkinOf skin_of)
    : contact_(contact), tissue_(tissue), frames_(frames), skin_of_(std::move(skin_of)) {}

void FiniteContact::move(Work& work, const Eigen::VectorXd& displacement) const {
  const Eigen::Map<const Points> nodes(displacement.data(), displacement.size() / 3, 3);
  work.skin = skin_of_(work.frame, nodes);
  for (std::size_t s = 0; s < work.at_sides.size(); ++s)
    work.at_sides[s] = frames_.places()[s]->moved(work.skin, nodes);
}

double FiniteContact::depth_m(const Work& work) const {
  return frames_.depths(work.frame, work.skin, work.at_sides).most();
}

FiniteContact::Round FiniteContact::round(Work& work, bool take_off, const Eigen::VectorXd* guess,
                                          Eigen::Ref<Eigen::VectorXd> best) {
  // The effect of the last round's forces, to first order at rest, is subtracted. The difference
  // between their effect in the displaced tissue and the required one then decreases from round to
  // round.
  if (take_off) contact_.take_off(work.first_order, work.skin, work.at_sides);
  const MouthContact::Correction next =
      contact_.correct({work.skin, work.at_sides, frames_.jaw(work.frame), frames_.upper_teeth()});
  force_.setZero(work.without.size());
  const std::vector<int>& nodes = contact_.nodes();
  for (std::size_t n = 0; n < nodes.size(); ++n)
    force_.segment<3>(3 * nodes[n]) = next.force.segment<3>(3 * Eigen::Index(n));
  work.first_order = next.moved;
  Eigen::VectorXd d;
  try {
    d = tissue_.under(force_, guess);
  } catch (const NumericalError&) {
    return Round::failed;
  }
  move(work, d);
  const double now_m = depth_m(work);
  if (!(now_m < work.least_m)) return Round::deeper;
  const bool little = !(now_m < kGainsLittle * work.least_m);
  work.least_m = now_m;
  work.residual_m = next.residual_m;
  best = d;
  last_ = {work.frame, d - work.without, work.first_order};
  return little ? Round::little : Round::better;
}

void FiniteContact::correct(std::size_t frame, Eigen::Ref<Eigen::VectorXd> displacement) {
  Work work{frame, displacement, frames_.skin(frame), frames_.at_sides(frame), {}, 0};
  work.least_m = depth_m(work);
  if (work.least_m >= hopeless_m_) {
    ++given_up_;
    return;
  }
  tissue_.begin(work.without);
  // The frame begins where contact left the one before.
  const bool follows = last_.in_all.size() > 0 && frame == last_.frame + 1;
  Eigen::VectorXd guess;
  if (follows) {
    guess = work.without + last_.in_all;
    work.first_order = last_.first_order;
    move(work, guess);
  }
  last_.in_all.resize(0);
  int idle = 0;
  for (int k = 0;
       k < kMostFiniteRounds && idle < kMostIdleRounds && work.least_m > kFiniteSettled_m; ++k) {
    const Round what =
        round(work, k > 0 || follows, k == 0 && follows ? &guess : nullptr, displacement);
    if (what == Round::failed) {
      // The frame stays as the rounds before left it, and deeper ones are not tried.
      if (k == 0) hopeless_m_ = std::min(hopeless_m_, work.least_m);
      given_up_ += k == 0;
      break;
    }
    idle = what == Round::better ? 0 : idle + 1;
  }
  residual_m_ = std::max(residual_m_, work.residual_m);
}

}  // namespace hyperex::simulate
