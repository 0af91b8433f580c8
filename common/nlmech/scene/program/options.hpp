/// @file
/// Commands of a program and their options. An option is declared once: name, member for its value, permitted
/// values and help.
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

/// An option or positional argument ("file"), and the destination of its value.
///
/// Texts are arbitrary and numbers finite. Numbers of a list are separated by commas, texts by blanks. A flag
/// has no value; `--flag=false` equals no flag.
class Option {
 public:
  /// Destination of the value. Its content is the default; an optional has none. A span requires all its
  /// numbers.
  using Destination =
      std::variant<std::string*, std::vector<std::string>*, bool*, double*, std::optional<double>*, int*,
                   std::optional<int>*, std::vector<double>*, std::span<double>>;
  /// @param name "--until", or "file" for a positional argument
  Option(std::string name, Destination to, std::string help);
  Option& required();                              ///< must be given
  Option& positive();                              ///< a number above 0
  Option& range(double least, double most);        ///< a number, or each of a list, from @p least to @p most
  Option& one_of(std::vector<std::string> texts);  ///< one of these texts

  /// Parses the typed texts into the destination. @throws InputError naming the option, the text and the
  /// permitted values
  void understand(const std::vector<std::string>& typed) const;

  [[nodiscard]] const std::string& name() const { return name_; }  ///< "--until"
  [[nodiscard]] bool is_required() const { return required_; }     ///< must it be given?
  [[nodiscard]] bool is_flag() const;                              ///< is it an option without a value?
  [[nodiscard]] bool takes_several() const;                        ///< is it a list of texts?
  [[nodiscard]] std::string_view kind() const;     ///< kind of the value for the help: "TEXT", "NUMBER"
  [[nodiscard]] std::string help() const;          ///< help with the range
  [[nodiscard]] std::string default_text() const;  ///< default value; empty if there is none
  [[nodiscard]] const std::vector<std::string>& texts() const { return texts_; }  ///< texts of one_of()

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
  /// Adds an Option. @param to member that lives as long as the command
  Option& add(const std::string& name, Option::Destination to, const std::string& help);
  /// Adds an Option for a text, a number, an optional number, a flag or a list.
  template <class T>
  requires std::is_constructible_v<Option::Destination, T*> Option& add(const std::string& name, T& to,
                                                                        const std::string& help) {
    return add(name, Option::Destination(&to), help);
  }
  /// Adds an Option for a vector of fixed size: x,y,z.
  template <class Vector>
  requires requires(Vector& v) {
    { v.derived().data() } -> std::same_as<double*>;
  }
  Option& add(const std::string& name, Vector& to, const std::string& help) {
    return add(name, Option::Destination(std::span<double>(to.data(), static_cast<std::size_t>(to.size()))),
               help);
  }
  /// Adds `--limit`, the wall time in seconds, for a command that heeds it itself; other commands get the
  /// option automatically.
  void limit(double& seconds);
  /// Adds `--limit` with the default `default_limit`, but without a limit if the option @p lifted_by (of
  /// many tasks) is given. @param lifted_by may be empty
  void limit(std::optional<double>& seconds, const std::string& lifted_by);
  static constexpr double default_limit = 60;  ///< default wall time of a command, s
  /// Removes the default limit of the command.
  void unlimited() { unlimited_ = true; }
  /// Sets the text below the help.
  void footer(const std::string& text) { footer_ = text; }

  /// All options.
  [[nodiscard]] const std::deque<Option>& all() const { return all_; }
  [[nodiscard]] bool supports_limit() const { return supports_limit_; }      ///< limit()
  [[nodiscard]] const std::string& lifted_by() const { return lifted_by_; }  ///< limit(); may be empty
  [[nodiscard]] bool is_unlimited() const { return unlimited_; }             ///< unlimited()
  [[nodiscard]] const std::string& footer() const { return footer_; }        ///< footer()

 private:
  std::deque<Option> all_;  // references to its elements stay valid
  bool supports_limit_ = false, unlimited_ = false;
  std::string footer_, lifted_by_;
};

/// Result of a command: an exit code, or a text to print.
using Answer = std::variant<int, std::string>;

/// Commands of a program: each has a struct of typed values, the options that fill it, and a function that
/// uses it.
class Commands {
 public:
  /// @param program name of the program, also in messages
  explicit Commands(std::string program) : program_(std::move(program)) {}
  /// Adds a command. @param declare adds the options, whose values go to members of the struct
  /// @param work returns a text to print, an exit code, or nothing. It throws InputError (exit code 2) or
  /// Failure (1), and prints nothing before it has succeeded
  /// @tparam Typed struct of the typed values
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
  /// Adds a command; the struct is that of the argument of @p declare.
  template <class Typed, class Work>
  void add(const std::string& name, const std::string& help, void (*declare)(Options&, Typed&), Work work) {
    add<Typed>(name, help, std::function<void(Options&, Typed&)>(declare), std::move(work));
  }

  /// A command for the parser.
  struct Command {
    std::string name;              ///< "run"
    std::string help;              ///< one line of help
    std::function<Answer()> work;  ///< runs the command with the values of the options
    Options options;               ///< options in the order of the help
  };
  [[nodiscard]] const std::deque<Command>& all() const {
    return all_;
  }  ///< commands in the order of the help
  [[nodiscard]] const std::string& program() const { return program_; }  ///< name of the program

 private:
  Options& add(const std::string& name, const std::string& help, std::function<Answer()> work);

  std::string program_;
  std::deque<Command> all_;
};

}  // namespace nlmech::scene
