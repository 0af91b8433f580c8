/// @file
/// Sharing of the machine's processors by the programs of this suite.
#pragma once

namespace nlmech::scene {

/// Queue of one user's programs for the processors of the machine: at most one program per processor
/// computes, so that a timed run has a processor of its own. It uses locks on a file in the system's
/// temporary folder, which the end of a program always releases. If the file cannot be created, no program
/// waits.
class Machine {
 public:
  /// @param processors number of programs that compute at once, >= 1; 0: the processors available to this
  /// process
  explicit Machine(int processors = 0);
  Machine(const Machine&) = delete;
  Machine& operator=(const Machine&) = delete;
  ~Machine();

  /// One processor, held until the destructor. A program holds at most one at a time.
  class Processor {
   public:
    /// Waits until a processor is free and all earlier programs have theirs.
    explicit Processor(Machine& machine);
    Processor(const Processor&) = delete;
    Processor& operator=(const Processor&) = delete;
    ~Processor();

   private:
    Machine& machine_;
    int number_ = 0;
  };

 private:
  int processors_;
  int file_ = -1;
};

}  // namespace nlmech::scene
