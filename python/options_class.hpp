// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A struct of options as a class of Python: made from keyword arguments, with a repr that can be
// typed in again, == and replace(). Ranges are checked where the C++ library checks them.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bind.hpp"
#include "hyperex/core/error.hpp"

namespace hyperex::python {

/// An enumeration as words: {{"held", Hold::held}, ...}.
template <class Enum>
using Words = std::vector<std::pair<std::string, Enum>>;

template <class Enum>
Enum from_word(const Words<Enum>& words, const std::string& name, const std::string& word) {
  std::vector<std::string> all;
  for (const auto& [text, value] : words) {
    if (text == word) return value;
    all.push_back(text);
  }
  throw InputError(InputProblem{{}, 0, name, word, fmt::format("one of {}", fmt::join(all, ", "))});
}

template <class Enum>
std::string to_word(const Words<Enum>& words, Enum value) {
  for (const auto& [text, enumerator] : words)
    if (enumerator == value) return text;
  throw std::logic_error("an enumerator without a word");
}

template <class T>
class OptionsClass {
 public:
  using Set = std::function<void(T&, py::handle)>;
  using Get = std::function<py::object(const T&)>;

  OptionsClass(py::module_& m, const char* name, const char* doc)
      : class_(m, name, doc), fields_(std::make_shared<std::vector<Field>>()) {
    const auto fields = fields_;
    class_.def(py::init([fields, name](const py::kwargs& given) {
      T options;
      fill(*fields, name, options, given);
      return options;
    }));
    class_.def(
        "replace",
        [fields, name](const T& self, const py::kwargs& given) {
          T options = self;
          fill(*fields, name, options, given);
          return options;
        },
        "A copy with the given fields changed.");
    class_.def("__copy__", [](const T& self) { return self; });
    class_.def("__deepcopy__", [](const T& self, const py::dict&) { return self; });
    class_.def("__repr__", [fields, name](const T& self) {
      std::vector<std::string> parts;
      for (const Field& field : *fields)
        parts.push_back(field.name + "=" + std::string(py::repr(field.get(self))));
      return fmt::format("{}({})", name, fmt::join(parts, ", "));
    });
    if constexpr (requires(const T& a) { a == a; })
      class_.def(
          "__eq__", [](const T& a, const T& b) { return a == b; }, py::is_operator());
  }

  /// A number, a truth value or another options class (which is handed out by reference).
  template <class V>
  OptionsClass& field(const char* name, V T::*member, const char* doc) {
    class_.def_property(
        name,
        py::cpp_function([member](T& self) -> V& { return self.*member; },
                         py::return_value_policy::reference_internal),
        setter(name, [member](T& self, py::handle v) { self.*member = v.cast<V>(); }), doc);
    keep(
        name, [member](const T& self) { return py::cast(self.*member); },
        [member](T& self, py::handle v) { self.*member = v.cast<V>(); });
    return *this;
  }

  /// Words for an enumeration.
  template <class Enum>
  OptionsClass& word(const char* name, Enum T::*member, Words<Enum> words, const char* doc) {
    return custom(
        name,
        [member, words](const T& self) -> py::object {
          return py::str(to_word(words, self.*member));
        },
        [member, words, name](T& self, py::handle v) {
          self.*member = from_word(words, name, v.cast<std::string>());
        },
        doc);
  }

  /// A list, handed out as a tuple: appending to a copy would change nothing, without a word.
  template <class V>
  OptionsClass& list(const char* name, std::vector<V> T::*member, const char* doc) {
    return custom(
        name, [member](const T& self) -> py::object { return py::tuple(py::cast(self.*member)); },
        [member, name](T& self, py::handle v) {
          if (py::isinstance<py::str>(v))
            throw py::type_error(std::string(name) + ": expected a list, not one string");
          self.*member = v.cast<std::vector<V>>();
        },
        doc);
  }

  OptionsClass& custom(const char* name, Get get, Set set, const char* doc) {
    class_.def_property(
        name, [get](const T& self) { return get(self); }, setter(name, set), doc);
    keep(name, get, set);
    return *this;
  }

  py::class_<T>& python_class() { return class_; }

 private:
  struct Field {
    std::string name;
    Get get;
    Set set;
  };

  static Set told(const char* name, Set set) {
    return [name, set](T& self, py::handle v) {
      try {
        set(self, v);
      } catch (const py::cast_error&) {
        throw py::type_error(fmt::format("{}: a value of type {} does not serve", name,
                                         std::string(py::str(py::type::of(v).attr("__name__")))));
      }
    };
  }
  static py::cpp_function setter(const char* name, Set set) {
    return py::cpp_function(
        [s = told(name, std::move(set))](T& self, const py::object& v) { s(self, v); });
  }
  void keep(const char* name, Get get, Set set) {
    fields_->push_back({name, std::move(get), told(name, std::move(set))});
  }
  static void fill(const std::vector<Field>& fields, const char* class_name, T& options,
                   const py::kwargs& given) {
    for (const auto& [key, value] : given) {
      const std::string name = py::str(key);
      const Field* found = nullptr;
      std::vector<std::string> all;
      for (const Field& field : fields) {
        if (field.name == name) found = &field;
        all.push_back(field.name);
      }
      if (!found)
        throw py::type_error(
            fmt::format("{} has no field {}; it has {}", class_name, name, fmt::join(all, ", ")));
      found->set(options, value);
    }
  }

  py::class_<T> class_;
  std::shared_ptr<std::vector<Field>> fields_;
};

}  // namespace hyperex::python
