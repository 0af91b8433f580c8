#include "nlmech/comparison/commands/typed_problem.hpp"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "nlmech/comparison/commands/problem_of_size.hpp"
#include "nlmech/comparison/reference/reference_of.hpp"
#include "nlmech/program/problem.hpp"
#include "nlmech/program/syntax.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/support/echo.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::comparison {
namespace {

class TypedProblem final : public ProblemOfSize {
 public:
  TypedProblem(program::Equations equations, program::Settings settings, std::string_view name)
      : equations_(std::move(equations)), settings_(std::move(settings)), problem_(equations_), name_(name) {}

  [[nodiscard]] std::string_view name() const override {
    return name_.empty() ? std::string_view("the equation") : std::string_view(name_);
  }
  [[nodiscard]] std::vector<std::pair<std::string, double>> parameters() const override {
    return equations_.parameters();
  }
  void set_parameter(std::string_view parameter, double value) override {
    settings_[std::string(parameter)] = value;
    equations_ = program::Equations(equations_.source(), settings_);
    problem_ = program::Problem(equations_);
  }
  [[nodiscard]] std::vector<std::string> state_names() const override { return equations_.state_names(); }
  [[nodiscard]] std::vector<double> initial_state() const override { return initial_state(""); }
  [[nodiscard]] std::vector<double> initial_state(const std::string& text) const override {
    if (!text.empty() && text.find('=') == std::string::npos) return OwnProblem::initial_state(text);
    return program::Equations(equations_).initial_state("--initial", text);
  }
  [[nodiscard]] double initial_time() const override { return equations_.initial_time().value_or(0); }
  [[nodiscard]] std::optional<double> final_time() const override { return equations_.final_time(); }
  [[nodiscard]] std::string_view equation() const override { return equations_.summary(); }
  [[nodiscard]] StateFunction expression(const std::string& option, const std::string& text) const override {
    return state_function(equations_, option, text);
  }
  [[nodiscard]] ivp::System system() const override { return ivp::System(problem_); }
  // A Taylor series in extended precision does not see where an equation switches.
  [[nodiscard]] std::vector<Candidate> extended(const Effort& effort) const override {
    if (problem_.switches() > 0) return {};
    return taylor_candidates(problem_, problem_.size(), effort);
  }

 private:
  program::Equations equations_;
  program::Settings settings_;
  program::Problem problem_;
  std::string name_;
};

}  // namespace

std::unique_ptr<OwnProblem> typed_problem(const program::SourceText& source,
                                          const program::Settings& settings, std::string_view name) {
  program::Equations equations(source, settings);
  return std::make_unique<TypedProblem>(std::move(equations), settings, name);
}

std::string read_equations(const std::string& name) {
  namespace fs = std::filesystem;
  std::error_code none;
  const fs::file_status what = fs::status(name, none);
  if (fs::is_character_file(what) || fs::is_block_file(what))
    throw input_error("--file {}: is a device; - is standard input", echoed_path(name));
  if (fs::is_regular_file(what) && fs::file_size(name, none) > program::most_bytes)
    throw input_error("--file {}: more than {} bytes", echoed_path(name), program::most_bytes);
  return scene::read_whole(name);
}

}  // namespace nlmech::comparison
