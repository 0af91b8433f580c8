// Step sizes by each rule of the step-size control: the formulas are exact, and so are the expected values.
#include "nlmech/ivp/step_control.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace nlmech::ivp::step_control_test {

StepControl started(const StepRule& rule, double length) {
  StepControl control(rule);
  control.start(length);
  return control;
}

TEST(StepControl, WhatIsLeftIsOneStepOrTwoEqualOnes) {
  StepControl control = started({}, 1);
  EXPECT_EQ(control.plan(0, 10), 1);
  EXPECT_EQ(control.plan(0, 1.5), 0.75);
  EXPECT_EQ(control.plan(0, 0.5), 0.5);
  EXPECT_EQ(control.plan(2, -1.0), 1) << "backwards in time";
  EXPECT_EQ(control.plan(2, 0.5), 1.25);
}

TEST(StepControl, FirstTrialIsStretchedToTheEnd) {
  StepControl control = started({.stretch = 1.25, .measured = true}, 1);
  EXPECT_EQ(control.plan(0, 2), 1) << "a stub may stay";
  EXPECT_EQ(control.plan(0, 1.25), 1.25);
  EXPECT_EQ(control.taken(), 1.25);
  EXPECT_TRUE(control.rejected(1));
  EXPECT_EQ(control.plan(0, 1.25), 1) << "no more after a rejection";
}

// Limits::largest_step also bounds the step that is stretched to reach t1.
TEST(StepControl, NoTrialIsLongerThanItsBound) {
  StepControl control = started(bounded({.largest = 2, .stretch = 1.25}, 1), 8);
  EXPECT_EQ(control.plan(0, 100), 1);
  EXPECT_EQ(control.plan(0, 1.25), 1);
  EXPECT_EQ(control.plan(0, -1.25), -1);
  EXPECT_EQ(control.plan(0, 0.75), 0.75);
  EXPECT_EQ(bounded({.largest = 2}, std::numeric_limits<double>::infinity()).largest, 2);
}

TEST(StepControl, LengthsStayWithinTheirBounds) {
  StepControl control = started({.largest = 2}, 8);
  EXPECT_EQ(control.plan(0, 100), 2);
  control.accepted(0);
  EXPECT_EQ(control.plan(1, 100), 1 + 16 * spacing(1));
  EXPECT_FALSE(control.rejected(1e-300)) << "none is shorter";
  StepControl free = started({.shortest = 0}, 1e-20);
  EXPECT_EQ(free.plan(1, 2), 1) << "lost in the time";
  free.start(1e-10);
  EXPECT_GT(free.plan(1, 2), 1);
  EXPECT_TRUE(free.rejected(1e-15));
  EXPECT_FALSE(free.rejected(1e-17));
  free.start(1);
  EXPECT_EQ(free.plan(0, 2), 1);
  EXPECT_FALSE(free.rejected(std::numeric_limits<double>::quiet_NaN())) << "no length";
}

TEST(StepControl, AfterARejectionStepsDoNotGrow) {
  StepControl control = started({}, 1), stays = started({.again = 0.5, .least_change = 1}, 1);
  for (StepControl* c : {&control, &stays}) {
    EXPECT_EQ(c->plan(0, 100), 1);
    EXPECT_TRUE(c->rejected(0.25));
    EXPECT_EQ(c->plan(0, 100), 0.25);
    EXPECT_TRUE(c->rejected(0.0625));
  }
  EXPECT_EQ(control.plan(0, 100), 0.0625);
  EXPECT_EQ(stays.plan(0, 100), 0.125) << "further ones halve";
  control.accepted(4);
  stays.accepted(0.01);
  EXPECT_EQ(control.length(), 0.0625);
  EXPECT_EQ(stays.length(), 0.125);
  EXPECT_EQ(control.plan(1, 100), 1.0625);
  control.accepted(4);
  EXPECT_EQ(control.length(), 4) << "but after the next";
}

TEST(StepControl, AStepCutShortSaysNothingAgainstThePlan) {
  StepControl control = started({}, 1), forgets = started({.kept_from = HUGE_VAL}, 1);
  for (StepControl* c : {&control, &forgets}) {
    EXPECT_EQ(c->plan(0, 1.5), 0.75);
    c->accepted(0.8);
  }
  EXPECT_EQ(control.length(), 1);
  EXPECT_EQ(forgets.length(), 0.8);
  static_cast<void>(control.plan(0, 1.5));
  control.accepted(0.5);
  EXPECT_EQ(control.length(), 0.5) << "unless its error says so";
}

TEST(StepControl, ErrorsThatGrowShortenTheNextStep) {
  StepControl control = started({}, 2);
  static_cast<void>(control.plan(0, 100));
  EXPECT_EQ(control.change(0.5, 0.25, 0.25), 2) << "nothing to compare with";
  control.accepted(4);
  static_cast<void>(control.plan(2, 100));
  EXPECT_EQ(control.change(0.5, 0.5, 0.5), 1) << "twice as long, twice the root";
  control.accepted(4);
  static_cast<void>(control.plan(6, 100));
  EXPECT_EQ(control.change(0.5, 1, 1), 0.25) << "as long, twice the root";
  control.forget();
  EXPECT_EQ(control.change(0.5, 1, 1), 0.5);
}

TEST(StepControl, MeasuredLengthsAreDifferencesOfEnds) {
  StepControl planned = started({}, 0.1), measured = started({.measured = true}, 0.1);
  const double t1 = planned.plan(1e6, 2e6);
  EXPECT_EQ(measured.plan(1e6, 2e6), t1);
  EXPECT_EQ(planned.taken(), 0.1);
  EXPECT_EQ(measured.taken(), t1 - 1e6);
  EXPECT_NE(measured.taken(), 0.1);
}

}  // namespace nlmech::ivp::step_control_test
