/// @file
/// Commands of a program and their options, each declared once: its name, the member that gets its value,
/// which values there are, and the words of the help.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace nlmech::scene {

/// An option, or a word without a name before it ("file"), and where its value goes.
///
/// Texts: any. Numbers are finite. Lists of numbers have commas between, of texts blanks. A flag has no
/// value; `--flag=false` is as without it.
class Option {
 public:
  /// What gets the value. A default is what stands there; an optional has none. Of a span, all numbers are
  /// needed.
  using Destination =
      std::variant<std::string*, std::vector<std::string>*, bool*, double*, std::optional<double>*, int*,
                   std::optional<int>*, std::vector<double>*, std::span<double>>;
  /// @param name "--until", or "file" for a word without one
  Option(std::string name, Destination to, std::string help);
  Option& required();                              ///< must be given
  Option& positive();                              ///< a number above 0
  Option& range(double least, double most);        ///< a number, or each of a list, from @p least to @p most
  Option& one_of(std::vector<std::string> texts);  ///< one of these texts

  /// Puts what was typed into the destination. @throws InputError naming the option, the text and what is
  /// allowed
  void understand(const std::vector<std::string>& typed) const;

  [[nodiscard]] const std::string& name() const { return name_; }  ///< "--until"
  [[nodiscard]] bool is_required() const { return required_; }     ///< must it be given?
  [[nodiscard]] bool is_flag() const;                              ///< has it no value?
  [[nodiscard]] bool takes_several() const;                        ///< texts with blanks between?
  [[nodiscard]] std::string_view kind() const;     ///< of its value: "TEXT", "NUMBER"; for the help
  [[nodiscard]] std::string help() const;          ///< with the range
  [[nodiscard]] std::string default_text() const;  ///< empty if there is none
  [[nodiscard]] const std::vector<std::string>& texts() const { return texts_; }  ///< one_of(); else none

 private:
  void check(double value, const std::string& text) const;
  void check_text(const std::string& text) const;
  [[nodiscard]] double number(const std::string& text) const;
  [[nodiscard]] int whole(const std::string& text) const;

  std::string name_, help_;
  Destination to_;
  bool required_ = false, positive_ = false;
  std::optional<std::pair<double, double>> range_;
  std::vector<std::string> texts_;
};

/// Options of one command, in the order of its help.
class Options {
 public:
  /// An option; see Option. @param to a member that lives as long as the command
  Option& add(const std::string& name, Option::Destination to, const std::string& help);
  /// The same for a member itself: a text, a number, an optional number, a flag, a list.
  template <class T>
  requires std::is_constructible_v<Option::Destination, T*> Option& add(const std::string& name, T& to,
                                                                        const std::string& help) {
    return add(name, Option::Destination(&to), help);
  }
  /// The same for a vector of fixed size: x,y,z.
  template <class Vector>
  requires requires(Vector& v) {
    { v.derived().data() } -> std::same_as<double*>;
  }
  Option& add(const std::string& name, Vector& to, const std::string& help) {
    return add(name, Option::Destination(std::span<double>(to.data(), static_cast<std::size_t>(to.size()))),
               help);
  }
  /// `--limit`, the wall time in seconds, for a command that heeds it by itself; all others are given one.
  void limit(double& seconds);
  /// The same; without it usual_limit, but as long as it takes if the option @p lifted_by, of many tasks, is
  /// given. Empty: none does.
  void limit(std::optional<double>& seconds, const std::string& lifted_by);
  static constexpr double usual_limit = 60;  ///< wall time of a command, s, if nothing is said
  /// The command takes as long as it takes, unless the user gives a limit.
  void unlimited() { unlimited_ = true; }
  /// Words below the help.
  void footer(const std::string& text) { footer_ = text; }

  /// All of them.
  [[nodiscard]] const std::deque<Option>& all() const { return all_; }
  [[nodiscard]] bool heeds_limit() const { return heeds_limit_; }            ///< limit()
  [[nodiscard]] const std::string& lifted_by() const { return lifted_by_; }  ///< limit(); empty: nothing
  [[nodiscard]] bool is_unlimited() const { return unlimited_; }             ///< unlimited()
  [[nodiscard]] const std::string& footer() const { return footer_; }        ///< footer()

 private:
  std::deque<Option> all_;  // references to its elements hold
  bool heeds_limit_ = false, unlimited_ = false;
  std::string footer_, lifted_by_;
};

/// How a command ends, if it throws nothing: with an exit code, or with a result that is printed.
using Answer = std::variant<int, std::string>;

/// Commands of a program: each is a struct of what a user may say, its options, and the work on it.
class Commands {
 public:
  /// @param program its name, as in what is said on standard error
  explicit Commands(std::string program) : program_(std::move(program)) {}
  /// A command. @param declare adds the options, whose values go to members of the struct
  /// @param work returns the text that is printed, an exit code, or nothing. It throws InputError (exit code
  /// 2) or Failure (1), and prints nothing before it is sure of all
  /// @tparam Typed the struct
  template <class Typed, class Work>
  void add(const std::string& name, const std::string& help,
           const std::type_identity_t<std::function<void(Options&, Typed&)>>& declare, Work work) {
    const auto typed = std::make_shared<Typed>();
    const auto answer = [typed, work]() -> Answer {
      if constexpr (std::is_void_v<std::invoke_result_t<Work, const Typed&>>) {
        work(*typed);
        return 0;
      } else {
        return work(*typed);
      }
    };
    declare(add(name, help, answer), *typed);
  }
  /// The same with the struct of a function that declares.
  template <class Typed, class Work>
  void add(const std::string& name, const std::string& help, void (*declare)(Options&, Typed&), Work work) {
    add<Typed>(name, help, std::function<void(Options&, Typed&)>(declare), std::move(work));
  }

  /// A command as the parser sees it.
  struct Command {
    std::string name;              ///< "run"
    std::string help;              ///< what it does, in a line
    std::function<Answer()> work;  ///< on what the options were set to
    Options options;               ///< in the order of the help
  };
  [[nodiscard]] const std::deque<Command>& all() const { return all_; }  ///< in the order of the help
  [[nodiscard]] const std::string& program() const { return program_; }  ///< its name

 private:
  Options& add(const std::string& name, const std::string& help, std::function<Answer()> work);

  std::string program_;
  std::deque<Command> all_;
};

}  // namespace nlmech::scene
