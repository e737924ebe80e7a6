// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A struct that describes its options (core/describe.hpp) as a class of Python: made from keyword
// arguments, with a repr that can be typed in again, == and replace(). `__annotations__` holds the
// types of its fields, from which the type stubs are made. Bounds are checked where the C++ library
// checks them.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bind.hpp"
#include "hyperex/core/describe.hpp"
#include "hyperex/core/error.hpp"

namespace hyperex::python {

template <Worded Enum>
std::vector<std::string> all_words() {
  std::vector<std::string> all;
  for (const auto& word : words_of(Enum{})) all.emplace_back(word.text);
  return all;
}

template <Worded Enum>
Enum from_word(const std::string& name, const std::string& word) {
  if (const auto value = value_of<Enum>(word)) return *value;
  throw InputError(InputProblem{
      {}, 0, name, word, fmt::format("one of {}", fmt::join(all_words<Enum>(), ", "))});
}

/// Literal["a", "b"]
inline std::string literal(const std::vector<std::string>& words) {
  return fmt::format("Literal[\"{}\"]", fmt::join(words, "\", \""));
}

/// The type annotation of a field of type V, as written in the stub file. A class of this module is
/// named by its Python name.
template <class V>
std::string type_name() {
  if constexpr (std::is_same_v<V, bool>)
    return "bool";
  else if constexpr (std::is_same_v<V, int>)
    return "int";
  else if constexpr (std::is_same_v<V, double>)
    return "float";
  else if constexpr (std::is_same_v<V, std::optional<double>>)
    return "float | None";
  else if constexpr (std::is_same_v<V, std::string>)
    return "str";
  else if constexpr (std::is_same_v<V, std::filesystem::path>)
    return "str | os.PathLike[str]";
  else if constexpr (std::is_same_v<V, std::array<double, 3>>)
    return "Sequence[float]";
  else if constexpr (Worded<V>)
    return literal(all_words<V>());
  else if constexpr (requires(V list) { list.push_back(list.front()); })
    return "Sequence[" + type_name<typename V::value_type>() + "]";
  else
    return py::str(py::type::of<V>().attr("__name__"));
}

template <class T>
class OptionsClass {
 public:
  using Set = std::function<void(T&, py::handle)>;
  using Get = std::function<py::object(const T&)>;

  /// With a field for each option that T describes.
  OptionsClass(py::module_& m, const char* name) requires Described<T>
      : OptionsClass(m, name, T::about) {
    T::describe(*this);
  }

  OptionsClass(py::module_& m, const char* name, const char* doc)
      : class_(m, name, doc), fields_(std::make_shared<std::vector<Field>>()) {
    const auto fields = fields_;
    class_.attr("__annotations__") = py::dict();
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

  // The visitor of a description.

  template <class At>
  void option(const char* member, At at, const char* sentence, const OptionDetails& details = {}) {
    using V = std::remove_cvref_t<decltype(at(std::declval<T&>()))>;
    const std::string name = python_name(member, details), doc = documented<V>(sentence, details);
    if constexpr (Worded<V>)
      custom(
          name,
          [at](const T& self) -> py::object { return py::str(std::string(word_of(at(self)))); },
          [at, name](T& self, py::handle v) {
            at(self) = from_word<V>(name, v.cast<std::string>());
          },
          type_name<V>(), doc);
    else if constexpr (requires(V list) { list.push_back(list.front()); } &&
                       !std::is_same_v<V, std::string>)
      list<V>(name, at, doc);
    else if constexpr (std::is_same_v<V, std::optional<double>>)
      custom(
          name, [at](const T& self) -> py::object { return py::cast(at(self)); },
          [at](T& self, py::handle v) { at(self) = v.cast<V>(); }, type_name<V>(), doc);
    else
      field<V>(name, at, doc);
  }

  /// A list of names, and a truth value beside it.
  template <class At, class AllAt>
  void one_or_all(const char* name, At at, const char* all_name, AllAt all_at,
                  const char* sentence) {
    option(name, at, sentence);
    option(all_name, all_at, fmt::format("All that there are, whatever `{}` holds.", name).c_str());
  }

  /// Rows of a name and a number, as a dict.
  template <class At, class Names>
  void factors(const char* name, At at, const Names&, const char* sentence,
               const OptionDetails& details) {
    using Row = typename std::remove_cvref_t<decltype(at(std::declval<T&>()))>::value_type;
    custom(
        name,
        [at](const T& self) -> py::object {
          py::dict all;
          for (const auto& [word, factor] : at(self)) all[py::str(word)] = factor;
          return all;
        },
        [at](T& self, py::handle v) {
          at(self).clear();
          for (const auto& [word, factor] : v.cast<std::map<std::string, double>>())
            at(self).push_back(Row{word, factor});
        },
        "Mapping[str, float]",
        documented<double>(sentence, details) + " A dict, handed out as a copy.");
  }

  OptionsClass& custom(const std::string& name, Get get, Set set, const std::string& type,
                       const std::string& doc) {
    class_.def_property(
        name.c_str(), [get](const T& self) { return get(self); }, setter(name, set), doc.c_str());
    keep(name, std::move(get), std::move(set), type);
    return *this;
  }

  py::class_<T>& python_class() { return class_; }

 private:
  struct Field {
    std::string name;
    Get get;
    Set set;
  };

  /// The sentence, and what the field may be.
  template <class V>
  static std::string documented(const std::string& sentence, const OptionDetails& details) {
    std::string doc = sentence;
    if constexpr (Described<V>)
      if (doc.empty()) doc = V::about;
    if constexpr (Worded<V>) doc += fmt::format(" One of {}.", fmt::join(all_words<V>(), ", "));
    if (!details.bounds.limited()) return doc;
    return doc + fmt::format(" {}{}{}.", details.bounds.text(), *details.unit.si_name ? " " : "",
                             details.unit.si_name);
  }

  /// A number, a truth value, a text or another options class (which is handed out by reference).
  template <class V, class At>
  void field(const std::string& name, At at, const std::string& doc) {
    const Set set = [at](T& self, py::handle v) { at(self) = v.cast<V>(); };
    class_.def_property(name.c_str(),
                        py::cpp_function([at](T& self) -> V& { return at(self); },
                                         py::return_value_policy::reference_internal),
                        setter(name, set), doc.c_str());
    keep(
        name, [at](const T& self) { return py::cast(at(self)); }, set, type_name<V>());
  }

  /// A list, handed out as a tuple: appending to a copy would change nothing, without a word.
  template <class V, class At>
  void list(const std::string& name, At at, const std::string& doc) {
    custom(
        name, [at](const T& self) -> py::object { return py::tuple(py::cast(at(self))); },
        [at, name](T& self, py::handle v) {
          if (py::isinstance<py::str>(v))
            throw py::type_error(name + ": expected a list, not one string");
          at(self) = v.cast<V>();
        },
        type_name<V>(), doc);
  }

  /// `set`, whose complaint about a value of another type names the field.
  static Set naming(const std::string& name, Set set) {
    return [name, set](T& self, py::handle v) {
      try {
        set(self, v);
      } catch (const py::cast_error&) {
        throw py::type_error(fmt::format("{}: a value of type {} cannot be used", name,
                                         std::string(py::str(py::type::of(v).attr("__name__")))));
      }
    };
  }
  static py::cpp_function setter(const std::string& name, Set set) {
    return py::cpp_function(
        [s = naming(name, std::move(set))](T& self, const py::object& v) { s(self, v); });
  }
  void keep(const std::string& name, Get get, Set set, const std::string& type) {
    class_.attr("__annotations__")[name.c_str()] = type;
    fields_->push_back({name, std::move(get), naming(name, std::move(set))});
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
