// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/stage_graph.hpp"

#include <algorithm>

namespace hyperex {
namespace {

thread_local const Stage* being_computed = nullptr;

}  // namespace

Stage::Stage(StageGraph& graph, std::string name, std::initializer_list<Input> inputs)
    : graph_(graph), name_(std::move(name)), inputs_(inputs) {
  for (const Input& input : inputs_) {
    HX_ASSERT(std::count(graph.own_.begin(), graph.own_.end(), input.stage) == 1);
    input.stage->dependents_.emplace_back(*this, input.on_change);
  }
  graph.stages_.push_back(this);
  graph.own_.push_back(this);
}

std::string Stage::inputs_in_words() const {
  std::string out;
  const auto list = [&](OnChange how, const char* before) {
    bool first = true;
    for (const Input& input : inputs_) {
      if (input.on_change != how) continue;
      if (!first)
        out += ", ";
      else if (!out.empty())
        out += "; ";
      if (first) out += before;
      out += input.stage->name();
      first = false;
    }
  };
  list(OnChange::drop, "");
  list(OnChange::refill, "refilled after ");
  list(OnChange::drop_unless_held, "unless held ");
  return out;
}

void Stage::pass_change_on() {
  for (const Input& to : dependents_) to.stage->input_changed(to.on_change);
}

void Stage::check_read() const {
  const Stage* reader = being_computed;
  // A thread that waits for others may meanwhile work for another graph.
  if (!reader || reader == this || &reader->graph_ != &graph_) return;
  const auto& named = reader->inputs_;
  if (std::none_of(named.begin(), named.end(), [&](const Input& i) { return i.stage == this; }))
    assertion_failed(("\"" + reader->name_ + "\" names its input \"" + name_ + "\"").c_str(),
                     __FILE__, __LINE__, __func__);
}

Stage::Computing::Computing(Stage& stage) : before_(being_computed) {
  being_computed = &stage;
  ++stage.computed_;
}
Stage::Computing::~Computing() {
  being_computed = before_;
}

void StageGraph::share(const StageGraph& other) {
  HX_ASSERT(own_.size() == other.own_.size());
  for (std::size_t i = 0; i < own_.size(); ++i) own_[i]->share(*other.own_[i]);
}

}  // namespace hyperex
