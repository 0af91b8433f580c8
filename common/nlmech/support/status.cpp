#include "nlmech/support/status.hpp"

#include <stdexcept>
#include <utility>

namespace nlmech {

std::string_view to_string(Outcome outcome) noexcept {
  switch (outcome) {
    case Outcome::success: return "success";
    case Outcome::step_limit: return "step_limit";
    case Outcome::time_limit: return "time_limit";
    case Outcome::step_underflow: return "step_underflow";
    case Outcome::non_finite: return "non_finite";
    case Outcome::newton_diverged: return "newton_diverged";
    case Outcome::singular_matrix: return "singular_matrix";
    case Outcome::not_converged: return "not_converged";
    case Outcome::spurious_root: return "spurious_root";
    case Outcome::wrong_branch: return "wrong_branch";
    case Outcome::at_pole: return "at_pole";
    case Outcome::collision: return "collision";
    case Outcome::outside_validity: return "outside_validity";
    case Outcome::infeasible: return "infeasible";
    case Outcome::interrupted: return "interrupted";
  }
  return "unknown";
}

Status Status::failure(Outcome outcome, std::string sentence) {
  if (outcome == Outcome::success) throw std::invalid_argument("Status::failure: the outcome is success");
  if (sentence.empty()) {
    throw std::invalid_argument("Status::failure: " + std::string(to_string(outcome)) +
                                " without a sentence");
  }
  Status status;
  status.outcome_ = outcome;
  status.sentence_ = std::move(sentence);
  return status;
}

std::string Status::text() const {
  return ok() ? "success" : std::string(to_string(outcome_)) + ": " + sentence_;
}

}  // namespace nlmech
