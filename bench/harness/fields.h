#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include <halfsilver/error.h>

// A struct lists its fields once, each with its key in JSON: kFields<T>. Files are written and read through that list,
// and tables take the names of their columns from it.
namespace halfsilver::bench {

// How JSON says that an optional field holds nothing.
enum class Empty { null, omitted };

template <class Owner, class Value>
struct Field {
  const char* key;
  Value Owner::*member;
  Empty empty;
};

template <class Owner, class Value>
constexpr Field<Owner, Value> field(const char* key, Value Owner::*member, Empty empty = Empty::null) {
  return {key, member, empty};
}

// The fields of a member stand beside its owner's. One that holds nothing has none.
template <class Owner, class Value>
struct Group {
  std::optional<Value> Owner::*member;
};

template <class Owner, class Value>
constexpr Group<Owner, Value> group(std::optional<Value> Owner::*member) {
  return {member};
}

// A std::tuple of field() and group(). Specialize it beside the struct; fields of a base class come first, by
// std::tuple_cat.
template <class T>
inline constexpr std::tuple<> kFields{};

template <class T>
concept Described = std::tuple_size_v<std::remove_cvref_t<decltype(kFields<T>)>> >
0;

namespace detail {

template <class Owner, class Value>
bool isFieldOf(const Field<Owner, Value>& field, Value Owner::*member) {
  return field.member == member;
}
template <class Entry, class Member>
bool isFieldOf(const Entry&, Member) {
  return false;
}

}  // namespace detail

// The key of a field. Throws Error (failed) if the member is not in the list.
template <class Owner, class Value>
std::string keyOf(Value Owner::*member) {
  const char* key = nullptr;
  const auto visit = [&](const auto& entry) {
    if constexpr (requires { entry.key; })
      if (detail::isFieldOf(entry, member)) key = entry.key;
  };
  std::apply([&](const auto&... entries) { (visit(entries), ...); }, kFields<Owner>);
  if (!key) throw Error(ErrorKind::failed, "a column of a table is no field of its struct");
  return key;
}

// Numbers in full precision, texts in quotes.
template <class T>
std::string exactText(const T& value) {
  return nlohmann::ordered_json(value).dump();
}
template <class T>
std::string exactText(const std::optional<T>& value) {
  return value ? exactText(*value) : std::string();
}

// Cells of a table. `members` is a tuple of pointers to members of T.
template <class... Members>
void addKeys(std::vector<std::string>& cells, const std::tuple<Members...>& members) {
  std::apply([&](auto... member) { (cells.push_back(keyOf(member)), ...); }, members);
}
template <class T, class... Members>
void addValues(std::vector<std::string>& cells, const T& value, const std::tuple<Members...>& members) {
  std::apply([&](auto... member) { (cells.push_back(exactText(value.*member)), ...); }, members);
}

namespace detail {

template <class T, class Owner, class Value>
void write(nlohmann::ordered_json& json, const T& value, const Field<Owner, Value>& field) {
  if constexpr (requires { (value.*field.member).has_value(); })
    if (field.empty == Empty::omitted && !(value.*field.member)) return;
  json[field.key] = value.*field.member;
}
template <class T, class Owner, class Value>
void write(nlohmann::ordered_json& json, const T& value, const Group<Owner, Value>& group) {
  if (value.*group.member) json.update(nlohmann::ordered_json(*(value.*group.member)));
}

template <class T, class Owner, class Value>
void read(const nlohmann::ordered_json& json, T& value, const Field<Owner, Value>& field) {
  if constexpr (requires { (value.*field.member).has_value(); })
    if (!json.contains(field.key)) return;
  json.at(field.key).get_to(value.*field.member);
}
template <class T, class Owner, class Value>
void read(const nlohmann::ordered_json& json, T& value, const Group<Owner, Value>& group) {
  if (json.contains(std::get<0>(kFields<Value>).key)) json.get_to((value.*group.member).emplace());
}

}  // namespace detail

// Throws Error (badInput) if a field is missing or of another type.
template <class T>
T fromJson(const nlohmann::ordered_json& json) {
  try {
    return json.get<T>();
  } catch (const nlohmann::json::exception& exception) {
    throw Error(ErrorKind::badInput, std::string("a measured point cannot be read: ") + exception.what());
  }
}

}  // namespace halfsilver::bench

template <halfsilver::bench::Described T>
struct nlohmann::adl_serializer<T> {
  static void to_json(ordered_json& json, const T& value) {
    json = ordered_json::object();
    std::apply([&](const auto&... entries) { (halfsilver::bench::detail::write(json, value, entries), ...); },
               halfsilver::bench::kFields<T>);
  }
  static void from_json(const ordered_json& json, T& value) {
    std::apply([&](const auto&... entries) { (halfsilver::bench::detail::read(json, value, entries), ...); },
               halfsilver::bench::kFields<T>);
  }
};

template <class T>
struct nlohmann::adl_serializer<std::optional<T>> {
  static void to_json(ordered_json& json, const std::optional<T>& value) {
    if (value)
      json = *value;
    else
      json = nullptr;
  }
  static void from_json(const ordered_json& json, std::optional<T>& value) {
    if (json.is_null())
      value.reset();
    else
      value = json.get<T>();
  }
};
