/// @file
/// The functions of equations.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace nlmech::program {

/// A function of one to three arguments. Those up to asinh are operations of the graph; the others are
/// composed of operations (Graph::call()).
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
  asinh,
  acosh,
  atanh,
  log10,
  log2,
  sec,
  csc,
  cot,
  abs,
  sign,
  heaviside,
  floor,
  ceil,
  round,
  frac,
  atan2,
  min,
  max,
  mod,
  choose,
  table,
  stepped_table
};

/// Name and number of arguments of a function.
struct FunctionInfo {
  Function function;      ///< the function
  std::string_view name;  ///< name in equations
  int arguments;          ///< number of arguments
};

/// All functions; some have two names.
inline constexpr std::array functions = {
    FunctionInfo{Function::sqrt, "sqrt", 1},      FunctionInfo{Function::exp, "exp", 1},
    FunctionInfo{Function::log, "log", 1},        FunctionInfo{Function::log, "ln", 1},
    FunctionInfo{Function::log10, "log10", 1},    FunctionInfo{Function::log2, "log2", 1},
    FunctionInfo{Function::sin, "sin", 1},        FunctionInfo{Function::cos, "cos", 1},
    FunctionInfo{Function::tan, "tan", 1},        FunctionInfo{Function::sec, "sec", 1},
    FunctionInfo{Function::csc, "csc", 1},        FunctionInfo{Function::cot, "cot", 1},
    FunctionInfo{Function::asin, "asin", 1},      FunctionInfo{Function::acos, "acos", 1},
    FunctionInfo{Function::atan, "atan", 1},      FunctionInfo{Function::atan2, "atan2", 2},
    FunctionInfo{Function::sinh, "sinh", 1},      FunctionInfo{Function::cosh, "cosh", 1},
    FunctionInfo{Function::tanh, "tanh", 1},      FunctionInfo{Function::asinh, "asinh", 1},
    FunctionInfo{Function::acosh, "acosh", 1},    FunctionInfo{Function::atanh, "atanh", 1},
    FunctionInfo{Function::erf, "erf", 1},        FunctionInfo{Function::abs, "abs", 1},
    FunctionInfo{Function::sign, "sign", 1},      FunctionInfo{Function::heaviside, "heaviside", 1},
    FunctionInfo{Function::heaviside, "step", 1}, FunctionInfo{Function::min, "min", 2},
    FunctionInfo{Function::max, "max", 2},        FunctionInfo{Function::floor, "floor", 1},
    FunctionInfo{Function::ceil, "ceil", 1},      FunctionInfo{Function::round, "round", 1},
    FunctionInfo{Function::frac, "frac", 1},      FunctionInfo{Function::mod, "mod", 2},
    FunctionInfo{Function::choose, "if", 3},      FunctionInfo{Function::table, "table", 1}};

/// The function with the name @p name, if there is one.
[[nodiscard]] constexpr std::optional<FunctionInfo> function_by_name(std::string_view name) {
  for (const FunctionInfo& info : functions) {
    if (info.name == name) return info;
  }
  return std::nullopt;
}

/// A hint for an unknown function: "atan is" for arctan, a list of all functions for gamma or besselj. Empty
/// for a name that resembles no known function.
[[nodiscard]] std::string function_hint(std::string_view name);

}  // namespace nlmech::program
