/// Named values of a file: /parameters and the attributes of its root.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

namespace pbmpi::io {

/// A value of /parameters or of a root attribute, with its type.
struct Parameter {
  enum class Type { text, integer, real };
  std::string name;
  Type type = Type::text;
  std::string text;
  std::int64_t integer = 0;
  double real = 0;

  static Parameter of(std::string name, std::string value) {
    return {std::move(name), Type::text, std::move(value), 0, 0};
  }
  static Parameter of(std::string name, std::int64_t value) {
    return {std::move(name), Type::integer, {}, value, 0};
  }
  static Parameter of(std::string name, double value) { return {std::move(name), Type::real, {}, 0, value}; }
};

}  // namespace pbmpi::io
