#include "nlmech/scene/run.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "nlmech/support/errors.hpp"

namespace nlmech::scene {
namespace {

using Names = std::vector<std::string>;

/// What is said by a mistake in the program; "" if it goes unnoticed.
template <class Action>
std::string complaint(Action action) {
  try {
    action();
    return "";
  } catch (const std::logic_error& error) {
    return error.what();
  }
}

/// Three runs in a chain: sum needs square, square needs base; and one that needs nothing.
struct Chain {
  int base_calls = 0, square_calls = 0, sum_calls = 0;
  scene::Run<int> base{"base", "as printed", {}, [this](Workshop&) { return ++base_calls, 3; }};
  scene::Run<int> square{"square", "as printed", {&base}, [this](Workshop& w) {
                           ++square_calls;
                           return w.result(base) * w.result(base);
                         }};
  scene::Run<int> sum{
      "sum", "as printed", {&square}, [this](Workshop& w) { return ++sum_calls, w.result(square) + 1; }};
  scene::Run<int> other{"other", "as printed", {}, [](Workshop&) { return 7; }};
};

TEST(Run, KnowsItsNameReadingAndNeeds) {
  Chain chain;
  EXPECT_EQ(chain.square.name(), "square");
  EXPECT_EQ(chain.square.reading(), "as printed");
  EXPECT_EQ(chain.square.needs(), std::vector<const AnyRun*>{&chain.base});
}

TEST(Workshop, ComputesARunOnceForAllScenes) {
  Chain chain;
  Workshop workshop(false);
  workshop.open("first", {&chain.base, &chain.square});
  EXPECT_EQ(chain.base_calls + chain.square_calls, 0) << "nothing is computed before it is asked for";
  const int& first = workshop.result(chain.square);
  EXPECT_EQ(first, 9);
  EXPECT_EQ(workshop.result(chain.base), 3);
  workshop.open("second", {&chain.square});
  EXPECT_EQ(&workshop.result(chain.square), &first) << "the very same object, not a copy";
  EXPECT_EQ(chain.base_calls, 1);
  EXPECT_EQ(chain.square_calls, 1);
}

TEST(Workshop, TellsRunsWhetherToBeQuick) {
  const scene::Run<bool> run("quick", "", {}, [](Workshop& w) { return w.quick(); });
  Workshop workshop(true);
  workshop.open("scene", {&run});
  EXPECT_TRUE(workshop.result(run));
}

TEST(Workshop, RefusesARunThatTheSceneHasNotDeclared) {
  Chain chain;
  Workshop workshop(false);
  workshop.open("fig-1", {&chain.base});
  EXPECT_EQ(complaint([&] { static_cast<void>(workshop.result(chain.other)); }),
            "fig-1 uses run other without declaring it");
  EXPECT_EQ(workshop.used(), Names{}) << "what was refused was not used";
}

TEST(Workshop, RefusesARunThatOnlyADeclaredRunNeeds) {
  Chain chain;
  Workshop workshop(false);
  workshop.open("fig-1", {&chain.square});
  EXPECT_EQ(complaint([&] { static_cast<void>(workshop.result(chain.base)); }),
            "fig-1 uses run base without declaring it");
}

TEST(Workshop, RefusesARunThatTheRunAtWorkHasNotDeclared) {
  Chain chain;
  const scene::Run<int> careless("careless", "", {}, [&](Workshop& w) { return w.result(chain.base); });
  Workshop workshop(false);
  workshop.open("fig-1", {&careless, &chain.base});
  EXPECT_EQ(complaint([&] { static_cast<void>(workshop.result(careless)); }),
            "careless uses run base without declaring it");
}

TEST(Workshop, RefusesARunOutsideAnyScene) {
  Chain chain;
  Workshop workshop(false);
  EXPECT_EQ(complaint([&] { static_cast<void>(workshop.result(chain.base)); }),
            "run base asked for outside any scene");
}

TEST(Workshop, ForgetsTheDeclarationsOfTheSceneBefore) {
  Chain chain;
  Workshop workshop(false);
  workshop.open("fig-1", {&chain.base});
  EXPECT_EQ(workshop.result(chain.base), 3);
  workshop.open("fig-2", {&chain.other});
  EXPECT_NE(complaint([&] { static_cast<void>(workshop.result(chain.base)); }), "")
      << "a result that is there all the same must be declared";
}

TEST(Workshop, ListsWhatWasUsedWithAllThatItRestsOn) {
  Chain chain;
  Workshop workshop(false);
  workshop.open("fig-1", {&chain.sum, &chain.other});
  EXPECT_EQ(workshop.used(), Names{});
  EXPECT_EQ(workshop.result(chain.sum), 10);
  EXPECT_EQ(workshop.used(), (Names{"base", "square", "sum"}));
}

TEST(Workshop, ListsRunsThatWereComputedForAnEarlierScene) {
  Chain chain;
  Workshop workshop(false);
  workshop.open("fig-1", {&chain.sum});
  EXPECT_EQ(workshop.result(chain.sum), 10);
  workshop.open("fig-2", {&chain.sum});
  EXPECT_EQ(workshop.used(), Names{}) << "a new scene starts with nothing";
  EXPECT_EQ(workshop.result(chain.sum), 10);
  EXPECT_EQ(workshop.used(), (Names{"base", "square", "sum"}));
  EXPECT_EQ(chain.sum_calls, 1);
}

TEST(Workshop, GoesOnAfterARunThatFailed) {
  Chain chain;
  const scene::Run<int> fails("fails", "", {}, [](Workshop&) -> int { throw Failure("no convergence"); });
  const scene::Run<int> copes("copes", "", {&fails, &chain.base}, [&](Workshop& w) {
    try {
      return w.result(fails);
    } catch (const Failure&) {
      return w.result(chain.base);  // declared by this run, not by the one that failed
    }
  });
  Workshop workshop(false);
  workshop.open("fig-1", {&copes, &chain.other});
  EXPECT_EQ(workshop.result(copes), 3);
  EXPECT_EQ(workshop.result(chain.other), 7);
}

}  // namespace
}  // namespace nlmech::scene
