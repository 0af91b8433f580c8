/// book_check FOLDER: loads every page of a book in a headless Chromium and says what is broken.
/// Exit 0: nothing; 1: something; 2: the check itself failed; 77: there is no book or no Chromium.
#include <chrono>
#include <cstdio>
#include <exception>

#include "tests/book/browser.hpp"
#include "tests/book/page_check.hpp"

int main(int argc, char** argv) {
  using namespace nlmech::tests;
  try {
    if (argc != 2) throw std::invalid_argument("usage: book_check FOLDER");
    if (!std::filesystem::exists(std::filesystem::path(argv[1]) / "index.html")) {
      std::printf("skipped: there is no book in %s; `make book` writes it\n", argv[1]);
      return 77;
    }
    const auto program = find_chromium();
    if (!program) {
      std::printf("skipped: no Chromium is installed (Debian package chromium)\n");
      return 77;
    }
    const auto begin = std::chrono::steady_clock::now();
    const Checked checked = check_pages(*program, argv[1]);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
    std::printf("%s%zu pages, %zu findings, %.0f s, %.1f s of them for %s\n",
                summary(checked.findings).c_str(), checked.pages.size(), checked.findings.size(),
                time.count(), checked.slowest_seconds, checked.slowest.c_str());
    return checked.findings.empty() ? 0 : 1;
  } catch (const std::exception& e) {
    static_cast<void>(std::fprintf(stderr, "book_check: %s\n", e.what()));
    return 2;
  }
}
