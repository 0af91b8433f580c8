#include "nlmech/program/repeated_program.hpp"

namespace nlmech::program {

machine_code::Values* RepeatedValues::make() const {
  std::call_once(once_, [this] {
    owner_ = machine_code::values(program_, first_, last_);
    ready_.store(owner_.get(), std::memory_order_release);
  });
  return owner_.get();
}

}  // namespace nlmech::program
