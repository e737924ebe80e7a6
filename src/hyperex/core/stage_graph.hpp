// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hyperex/core/assert.hpp"

namespace hyperex {

/// What happens to the value of a stage when one of its inputs changes.
enum class OnChange {
  drop,             ///< it is dropped, and computed anew when it is next required
  refill,           ///< it is out of date, but its memory is kept for other numbers
  drop_unless_held  ///< it is dropped, unless the stage is held (Cached::hold)
};

class StageGraph;

/// One value of a graph, with the inputs that it was declared with. Inputs are declared before the
/// stages that name them, and so there are no cycles.
///
/// A stage that is dropped or out of date passes the change on to the stages that name it. A stage
/// without a value passes nothing on, since nothing was computed from it.
class Stage {
 public:
  struct Input {
    Input(Stage& of, OnChange how = OnChange::drop) : stage(&of), on_change(how) {}
    Stage* stage;
    OnChange on_change;
  };
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;
  virtual ~Stage() = default;

  const std::string& name() const { return name_; }
  const std::vector<Input>& inputs() const { return inputs_; }
  /// "motion, region; refilled after tissue; unless held support".
  std::string inputs_in_words() const;
  /// How often the value was computed or refilled in this graph.
  int computed() const { return computed_; }
  virtual bool has_value() const = 0;

 protected:
  Stage(StageGraph& graph, std::string name, std::initializer_list<Input> inputs);
  /// Notifies the stages that have this one as an input.
  void pass_change_on();
  /// Ends the program where a stage that is being computed on this thread reads this one without
  /// naming it: it would not be dropped when this one changes.
  void check_read() const;
  /// While it lives, the stage is being computed on this thread.
  class Computing {
   public:
    explicit Computing(Stage& stage);
    ~Computing();
    Computing(const Computing&) = delete;

   private:
    const Stage* before_;
  };

 private:
  friend class StageGraph;
  virtual void input_changed(OnChange how) = 0;
  /// Takes over what copies of a graph have in common.
  virtual void share(const Stage& other) = 0;

  const StageGraph& graph_;
  std::string name_;
  std::vector<Input> inputs_, dependents_;  // dependents_: stages with this input
  int computed_ = 0;
};

/// Values that are computed from one another, and dropped exactly when one of their inputs changes.
/// A struct of stages derives from this; each stage is given the graph as it is declared. One
/// caller at a time, but stages without a value may be computed side by side.
class StageGraph {
 public:
  StageGraph() = default;
  StageGraph(const StageGraph&) = delete;
  StageGraph& operator=(const StageGraph&) = delete;

  /// In the order of their declaration.
  const std::vector<const Stage*>& stages() const { return stages_; }
  /// Takes over the values of Cached and Checked stages. `other` is declared by the same struct.
  void share(const StageGraph& other);

 protected:
  const std::vector<Stage*>& own_stages() const { return own_; }

 private:
  friend class Stage;
  std::vector<const Stage*> stages_;
  std::vector<Stage*> own_;  // the same
};

/// A value that is set from outside and stored elsewhere, such as options.
class Source : public Stage {
 public:
  Source(StageGraph& graph, std::string name) : Stage(graph, std::move(name), {}) {}
  void change() { pass_change_on(); }
  bool has_value() const override { return true; }

 private:
  void input_changed(OnChange) override {}
  void share(const Stage&) override {}
};

/// A value that other work computes, such as a part of another stage. It is kept when its inputs
/// change. Setting an equal value changes nothing; setting another one does.
template <class T>
class Checked final : public Stage {
 public:
  Checked(StageGraph& graph, std::string name, std::initializer_list<Input> inputs)
      : Stage(graph, std::move(name), inputs) {}

  void set(T value) {
    if (value_ && *value_ == value) return;
    value_ = std::move(value);
    pass_change_on();
  }
  bool has_value() const override { return value_.has_value(); }
  const T& value() const {
    check_read();
    HX_ASSERT(value_);
    return *value_;
  }

 private:
  void input_changed(OnChange) override {}
  void share(const Stage& other) override { value_ = static_cast<const Checked&>(other).value_; }
  std::optional<T> value_;
};

/// A value that does not change once it is computed; copies of a graph share it.
template <class T>
class Cached final : public Stage {
 public:
  using Pointer = std::shared_ptr<const T>;
  Cached(StageGraph& graph, std::string name, std::initializer_list<Input> inputs)
      : Stage(graph, std::move(name), inputs) {}

  /// Computes the value where there is none; `make` returns a Pointer.
  template <class Make>
  void ensure(const Make& make) {
    if (value_) return;
    const Computing computing(*this);
    value_ = make();
  }
  bool has_value() const override { return value_ != nullptr; }
  const T& value() const {
    check_read();
    HX_ASSERT(value_);
    return *value_;
  }
  const T* operator->() const { return &value(); }
  /// Null where there is no value.
  const Pointer& pointer() const {
    check_read();
    return value_;
  }
  /// Stores a value that was computed on the way to another stage, unless there is one.
  void keep(Pointer value) {
    if (!value_) value_ = std::move(value);
  }
  /// Another value. What was computed from the one before is dropped.
  void replace(Pointer value) {
    if (value == value_) return;
    input_changed(OnChange::drop);
    value_ = std::move(value);
  }
  /// The same value with further parts computed. Stages computed from it are kept.
  void complete(Pointer value) { value_ = std::move(value); }
  /// From now on changes of inputs with OnChange::drop_unless_held leave the value.
  void hold() { held_ = true; }
  bool held() const { return held_; }

 private:
  void input_changed(OnChange how) override {
    HX_ASSERT(how != OnChange::refill);
    if (!value_ || (held_ && how == OnChange::drop_unless_held)) return;
    value_.reset();
    pass_change_on();
  }
  void share(const Stage& other) override {
    const Cached& from = static_cast<const Cached&>(other);
    value_ = from.value_;
    held_ = from.held_;
  }
  Pointer value_;
  bool held_ = false;
};

/// A value that changes as it is used or refilled; copies of a graph begin without it.
template <class T>
class Owned final : public Stage {
 public:
  Owned(StageGraph& graph, std::string name, std::initializer_list<Input> inputs)
      : Stage(graph, std::move(name), inputs) {}

  /// Computes the value where there is none (`make` returns a T), and has `refill` (of a T&) bring
  /// it up to date where it is not.
  template <class Make, class Refill>
  void ensure(const Make& make, const Refill& refill) {
    if (value_ && up_to_date_) return;
    const Computing computing(*this);
    up_to_date_ = false;
    if (value_)
      refill(*value_);
    else
      value_.emplace(make());
    up_to_date_ = true;
  }
  /// For stages without an input that refills.
  template <class Make>
  void ensure(const Make& make) {
    ensure(make, [](T&) { HX_ASSERT(false); });
  }
  bool has_value() const override { return value_.has_value(); }
  bool is_up_to_date() const { return value_ && up_to_date_; }
  T& value() {
    check_read();
    HX_ASSERT(value_);
    return *value_;
  }
  T* operator->() { return &value(); }
  /// Takes the value of another graph, to be refilled.
  void take(Owned& from) {
    input_changed(OnChange::drop);
    value_ = std::move(from.value_);
    from.input_changed(OnChange::drop);
    up_to_date_ = false;
  }
  void drop() { input_changed(OnChange::drop); }

 private:
  void input_changed(OnChange how) override {
    if (!value_ || (how == OnChange::refill && !up_to_date_)) return;
    if (how == OnChange::refill)
      up_to_date_ = false;
    else
      value_.reset();
    pass_change_on();
  }
  void share(const Stage&) override {}
  std::optional<T> value_;
  bool up_to_date_ = false;
};

}  // namespace hyperex
