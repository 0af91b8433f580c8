/// @file
/// Measuring times while no other program of this suite computes.
#pragma once

namespace nlmech::scene {

/// The machine as the programs of one user share it: any number compute side by side, or one measures times.
/// By a lock on a file in the system's folder for temporary files; a program that ends, however it does,
/// gives it back. Where no such file can be made, nobody waits.
class Machine {
 public:
  /// Waits while another program measures times.
  Machine();
  Machine(const Machine&) = delete;
  Machine& operator=(const Machine&) = delete;
  ~Machine();

  /// Until it is destroyed, no other program computes; made inside another one, it changes nothing.
  class Alone {
   public:
    /// Waits until the others are done, and says so on a terminal.
    explicit Alone(Machine& machine);
    Alone(const Alone&) = delete;
    Alone& operator=(const Alone&) = delete;
    ~Alone();

   private:
    Machine& machine_;
    bool outermost_;
  };

 private:
  int file_ = -1;
  bool taken_ = false;
};

}  // namespace nlmech::scene
