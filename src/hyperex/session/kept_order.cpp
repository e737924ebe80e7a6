// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/kept_order.hpp"

#include <exception>
#include <memory>
#include <utility>

#include "hyperex/core/packed.hpp"
#include "hyperex/fem/solve/node_order.hpp"
#include "hyperex/session/kept.hpp"

namespace hyperex::session {
namespace {

/// The key of an order: the pattern of the matrices, and the options that usually determine which
/// unknowns are prescribed. The stored order is checked against the prescribed unknowns.
std::string order_key(const scene::Scene& scene, const Inputs& inputs,
                      const simulate::Simulator& simulator) {
  Packer of;
  of(simulator.mesh().volume.tets, scene.model.element, scene.drive.by, scene.drive.patch_radius_m,
     scene.support.border_held, scene.support.skull, scene.support.mandible, inputs.driven);
  return kept_key("order", of.bytes());
}

/// Each of `free` exactly once, and of all unknowns those that are not free, rising.
bool is_order(const std::vector<int>& prescribed, const std::vector<int>& free) {
  std::vector<char> named(free.size(), 0);
  for (const int k : free) {
    if (k < 0 || std::size_t(k) >= free.size() || named[std::size_t(k)]) return false;
    named[std::size_t(k)] = 1;
  }
  for (std::size_t i = 0; i < prescribed.size(); ++i)
    if (prescribed[i] < (i > 0 ? prescribed[i - 1] + 1 : 0)) return false;
  return prescribed.empty() || std::size_t(prescribed.back()) < prescribed.size() + free.size();
}

}  // namespace

std::string bytes_of(const simulate::EliminationOrder& order) {
  Packer packer;
  packer(order.prescribed, order.nodes->unknowns, order.nodes->entries, order.nodes->flops);
  return packer.bytes();
}

std::shared_ptr<const simulate::EliminationOrder> order_from(const std::string& bytes) {
  try {
    Unpacker unpacker(bytes);
    auto nodes = std::make_shared<fem::NodeOrder>();
    auto order = std::make_shared<simulate::EliminationOrder>();
    unpacker(order->prescribed, nodes->unknowns, nodes->entries, nodes->flops);
    if (!unpacker.at_end() || !is_order(order->prescribed, nodes->unknowns)) return nullptr;
    order->nodes = std::move(nodes);
    return order;
  } catch (const std::exception&) {
    return nullptr;
  }
}

void prepare_with_kept_order(const scene::Scene& scene, const Inputs& inputs,
                             simulate::Simulator& simulator) {
  if (!scene.kept.in_use()) return simulator.prepare();
  const std::string key = order_key(scene, inputs, simulator);
  if (const auto bytes = scene.kept.find(key)) simulator.use_order(order_from(*bytes));
  const auto given = simulator.elimination_order();
  simulator.prepare();
  if (const auto used = simulator.elimination_order(); used && used != given)
    scene.kept.keep(key, bytes_of(*used));
}

}  // namespace hyperex::session
