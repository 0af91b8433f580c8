/// @file
/// The processors of the machine, shared by the programs of this suite.
#pragma once

namespace nlmech::scene {

/// The machine as the programs of one user share it: no more of them compute at once than it has processors,
/// in turn, so that a run whose time is taken has a processor to itself. By locks on a file in the system's
/// folder for temporary files; a program that ends, however it does, gives back what it holds. Where no such
/// file can be made, nobody waits.
class Machine {
 public:
  /// @param processors how many compute at once, >= 1; by default as many as the system lets this one use
  explicit Machine(int processors = 0);
  Machine(const Machine&) = delete;
  Machine& operator=(const Machine&) = delete;
  ~Machine();

  /// One processor, for as long as this lives. A program asks for one at a time.
  class Processor {
   public:
    /// Waits until one is free and those who came before have theirs.
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
