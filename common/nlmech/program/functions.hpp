/// @file
/// The functions that an equation may name.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace nlmech::program {

/// A function of one or two arguments.
enum class Function : std::uint8_t {
  sqrt,
  exp,
  log,
  sin,
  cos,
  tan,
  asin,
  acos,
  atan,
  sinh,
  cosh,
  tanh,
  erf,
  abs,
  sign,
  atan2,
  min,
  max
};

/// How it is written.
struct FunctionInfo {
  Function function;      ///< which
  std::string_view name;  ///< as in an equation
  int arguments;          ///< how many
};

/// All of them.
inline constexpr std::array functions = {
    FunctionInfo{Function::sqrt, "sqrt", 1}, FunctionInfo{Function::exp, "exp", 1},
    FunctionInfo{Function::log, "log", 1},   FunctionInfo{Function::sin, "sin", 1},
    FunctionInfo{Function::cos, "cos", 1},   FunctionInfo{Function::tan, "tan", 1},
    FunctionInfo{Function::asin, "asin", 1}, FunctionInfo{Function::acos, "acos", 1},
    FunctionInfo{Function::atan, "atan", 1}, FunctionInfo{Function::sinh, "sinh", 1},
    FunctionInfo{Function::cosh, "cosh", 1}, FunctionInfo{Function::tanh, "tanh", 1},
    FunctionInfo{Function::erf, "erf", 1},   FunctionInfo{Function::abs, "abs", 1},
    FunctionInfo{Function::sign, "sign", 1}, FunctionInfo{Function::atan2, "atan2", 2},
    FunctionInfo{Function::min, "min", 2},   FunctionInfo{Function::max, "max", 2}};

/// The function of that name, if there is one.
[[nodiscard]] constexpr std::optional<FunctionInfo> function_by_name(std::string_view name) {
  for (const FunctionInfo& info : functions) {
    if (info.name == name) return info;
  }
  return std::nullopt;
}

}  // namespace nlmech::program
