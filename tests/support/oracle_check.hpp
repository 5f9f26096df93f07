// Holds the solver of discrete contact problems against the oracle of small ones, and counts what came out.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "cd/discrete/solve.hpp"
#include "tests/support/contact_oracle.hpp"
#include "tests/support/random_contacts.hpp"

namespace galet::cd {

struct OracleCount {
  int asked = 0;
  int solved = 0;    ///< by the solver
  int none = 0;      ///< have no solution: by a contradiction, or in 2D by enumeration
  int blamed = 0;    ///< of those with a contradiction, the solver names it
  int proved = 0;    ///< problems with a contradiction
  int missed = 0;    ///< have a solution for certain, and the solver found none in its time
  int near = 0;      ///< answers with an exact solution next to them
  double worst = 0;  ///< largest distance between the two, relative to |r| + |q|, scaled
  OracleCount& operator+=(const OracleCount& other) {
    asked += other.asked, solved += other.solved, none += other.none, blamed += other.blamed;
    proved += other.proved, missed += other.missed, near += other.near;
    worst = std::max(worst, other.worst);
    return *this;
  }
};

/// Regular and singular W, mu from 0 to 10, cohesion, compliance, moving walls, wedges.
inline RandomContacts random_kind(int block, int number, double mass_ratio, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  RandomContacts kind;
  kind.block = block;
  kind.contacts = 1 + number % 5;
  kind.freedoms = 2 + static_cast<int>(uniform(random) * (block * kind.contacts + 4));
  kind.mu = number % 7 == 0 ? 0 : std::pow(10, 3 * uniform(random) - 2);
  kind.mu_r = kind.mu * uniform(random);
  kind.mass_ratio = mass_ratio;
  if (number % 4 == 1) kind.cohesion = 1;
  if (number % 4 == 2) kind.compliance = 0.01;
  if (number % 4 == 3) kind.walls = 0.3;
  kind.wedge = number % 20 == 19 && kind.contacts > 1;
  return kind;
}

inline void check_problem(const RandomContacts& kind, const DiscreteProblem& problem, OracleCount& count) {
  const ContactOracle oracle(problem);
  DiscreteOptions options;
  options.error = 1e-10;
  options.seconds = 0.03;
  const DiscreteSolution solution = solve(problem, options);
  for (const double value : solution.r) ASSERT_TRUE(std::isfinite(value));
  // Time is looked at between iterations and errors; some of the first are factorisations.
  EXPECT_LT(solution.seconds, options.seconds + 0.1);
  EXPECT_EQ(solution.converged, solution.reason == "error reached");
  ++count.asked, count.solved += solution.converged;

  const ContactOracle::Real contradiction = oracle.contradiction();
  const bool proved = contradiction > 1e-9L * oracle.load();
  if (kind.wedge) {
    EXPECT_TRUE(proved);
  }
  if (solution.reason == "no solution") {
    EXPECT_FALSE(contradiction <= 0) << "said to have no solution";
    EXPECT_FALSE(solution.contradiction.empty());
  }
  if (proved) {
    ++count.proved, ++count.none, count.blamed += solution.reason == "no solution";
    EXPECT_FALSE(solution.converged) << "a problem without a solution";
  } else if (!solution.converged) {
    // Motions of bodies alone (no walls) can stop everything: a solution exists.
    const bool some = kind.walls == 0 || (kind.block == 2 && !oracle.enumerate(2, 1e-13L).empty());
    count.missed += some, count.none += !some && kind.block == 2;
  }
  if (!solution.converged) return;
  const auto r = oracle.scaled(solution.r);
  // Redundant contacts that rest at an edge are as far from it as the error allows: 1e-10 times their condition.
  const auto exact = oracle.next_to(r, 1e-8L);
  if (!exact) return;
  ++count.near;
  count.worst = std::max(count.worst, static_cast<double>((*exact - r).norm() / (r.norm() + oracle.load())));
}

inline OracleCount check_random_problems(int block, int number, double mass_ratio) {
  std::mt19937 random(11 + block);
  OracleCount count;
  for (int k = 0; k < number; ++k) {
    const RandomContacts kind = random_kind(block, k, mass_ratio, random);
    SCOPED_TRACE(testing::Message() << "block " << block << ", number " << k);
    check_problem(kind, random_contacts(kind, random), count);
  }
  return count;
}

inline std::string text_of(const OracleCount& count) {
  return fmt::format(
      "asked {}, solved {}, without solution {} ({} proved, {} of them named), missed {}, exact solution "
      "next to {}, at most {:.1e} away",
      count.asked, count.solved, count.none, count.proved, count.blamed, count.missed, count.near, count.worst);
}

/// For masses of one size.
inline void expect_sound(const OracleCount& count) {
  SCOPED_TRACE(text_of(count));
  EXPECT_EQ(count.blamed, count.proved);
  EXPECT_GE(count.near, count.solved - count.solved / 1000);
  // errS times the condition of the systems that the states leave, up to 1e5 in random ones.
  EXPECT_LT(count.worst, 1e-4);
  // Large friction at contacts that others make redundant is where no method is certain to arrive in time.
  EXPECT_LE(count.missed, 1 + count.asked / 1000);
}

}  // namespace galet::cd
