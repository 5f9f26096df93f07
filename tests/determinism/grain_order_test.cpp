// md keeps its grains in an order of its own: nobody outside can tell, and histories come along.
#include "md/grain_order.hpp"

#include <map>
#include <numeric>
#include <tuple>

#include <gtest/gtest.h>

#include "common/core/permutation.hpp"
#include "common/core/random.hpp"
#include "common/neighbour/image.hpp"
#include "tests/determinism/sheared.hpp"

namespace galet::test::grain_order_test {
namespace {

std::vector<int> shuffled(int count, std::uint64_t seed) {
  std::vector<int> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  for (int k = count - 1; k > 0; --k)
    std::swap(order[k], order[static_cast<int>(RandomStream(seed, k).uniform(0, 1) * (k + 1))]);
  return order;
}

/// The grain that comes k-th was order[k].
template <int D>
Sample<D> renumbered(const Sample<D>& sample, const std::vector<int>& order) {
  Sample<D> other = sample;
  Permutation step;
  step.set(order);
  step.apply(other.position), step.apply(other.velocity), step.apply(other.spin);
  step.apply(other.radius), step.apply(other.mass), step.apply(other.material);
  return other;
}

/// Enough grains to be sorted.
template <int D>
Sample<D> many_grains() {
  Sample<D> sample = crystal_sample<D>(D == 2 ? 30 : 8, 1.002);
  EXPECT_GE(sample.count(), md::least_sorted_grains);
  vary_sizes<D>(sample, 0.001, 51);
  shake<D>(sample, 0.3, 52, 0.3);
  return sample;
}

template <int D>
void expect_same_contacts(const Snapshot<D>& one, const Snapshot<D>& other) {
  const ContactColumns<D>&a = *one.contacts, &b = *other.contacts;
  EXPECT_GT(a.size(), 100u);
  EXPECT_EQ(a.i, b.i);
  EXPECT_EQ(a.j, b.j);
  EXPECT_EQ(a.image, b.image);
  EXPECT_EQ(a.gap, b.gap);
  EXPECT_EQ(a.force, b.force);
  EXPECT_EQ(a.normal, b.normal);
  EXPECT_EQ(a.branch, b.branch);
  EXPECT_EQ(a.torque, b.torque);
  EXPECT_EQ(a.touching, b.touching);
}

template <int D>
void expect_same_grains(const Snapshot<D>& one, const Snapshot<D>& other) {
  for (int i = 0; i < one.grains(); ++i) {
    ASSERT_EQ(one.position[i], other.position[i]) << i;
    ASSERT_EQ(one.velocity[i], other.velocity[i]) << i;
    ASSERT_EQ(one.spin[i], other.spin[i]) << i;
    ASSERT_EQ(one.radius[i], other.radius[i]) << i;
    ASSERT_EQ(one.mass[i], other.mass[i]) << i;
  }
}

/// Whatever numbers the grains have, they lie in the same order in memory: sums, and so all bits, are the same.
template <int D>
void check_numbering(const RichLaw* law) {
  SCOPED_TRACE("D = " + std::to_string(D) + (law ? " " + law->name : ""));
  Sample<D> sample = many_grains<D>();
  Scene scene = sheared_scene<D>(0.3, 1);
  if (law) {
    law->change(scene);
    mix_materials<D>(scene, sample);
  }
  // Means over the grains are sums in the order of their numbers: the step is given, and no stress drives the cell.
  scene.md.dt = *derive_for<D>(scene, sample).md_dt;
  scene.loading.pressure.reset();
  const Derived derived = derive_for<D>(scene, sample);
  const std::vector<int> order = shuffled(sample.count(), 7);
  const auto plain = md::make_engine<D>(scene, derived, sample);
  const auto other = md::make_engine<D>(scene, derived, renumbered<D>(sample, order));
  plain->advance(60), other->advance(60);

  Permutation back;
  back.set(order);
  const Snapshot<D> expected = plain->snapshot(), found = other->snapshot();
  for (int k = 0; k < sample.count(); ++k) {
    const int i = back.from(k);
    ASSERT_EQ(found.position[k], expected.position[i]) << k;
    ASSERT_EQ(found.velocity[k], expected.velocity[i]) << k;
    ASSERT_EQ(found.spin[k], expected.spin[i]) << k;
    ASSERT_EQ(found.radius[k], expected.radius[i]) << k;
  }
  ASSERT_EQ(found.contacts->size(), expected.contacts->size());
  EXPECT_GT(expected.contacts->size(), 100u);
  std::map<std::tuple<int, int, Image<D>>, std::size_t> contact;
  const ContactColumns<D>&from = *expected.contacts, &to = *found.contacts;
  for (std::size_t c = 0; c < from.size(); ++c) contact[{from.i[c], from.j[c], from.image[c]}] = c;
  for (std::size_t c = 0; c < to.size(); ++c) {
    ASSERT_LT(to.i[c], to.j[c]);
    const int i = back.from(to.i[c]), j = back.from(to.j[c]);
    const bool turned = j < i;
    const auto at = contact.find({std::min(i, j), std::max(i, j), turned ? negative<D>(to.image[c]) : to.image[c]});
    ASSERT_NE(at, contact.end()) << c;
    const double sign = turned ? -1 : 1;
    ASSERT_EQ(to.force[c], sign * from.force[at->second]) << c;
    ASSERT_EQ(to.normal[c], sign * from.normal[at->second]) << c;
    ASSERT_EQ(to.branch[c], sign * from.branch[at->second]) << c;
    ASSERT_EQ(to.gap[c], from.gap[at->second]) << c;
    if (!to.torque.empty()) {
      ASSERT_EQ(to.torque[c], sign * from.torque[at->second]) << c;
    }
  }
  EXPECT_EQ(other->energy().total(), plain->energy().total());
}

TEST(determinism, NumbersOfTheGrainsDontMatter) {
  check_numbering<2>(nullptr);
  check_numbering<3>(nullptr);
}
TEST(determinism, NumbersOfTheGrainsDontMatterWithAnyLaw) {
  for (const RichLaw& law : rich_laws()) check_numbering<2>(&law), check_numbering<3>(&law);
}

std::vector<std::int64_t> order_of(const Archive& archive) { return integer_column(archive, "md.order"); }

/// The same state in another order of the memory.
template <int D>
void check_carried(const RichLaw* law) {
  SCOPED_TRACE("D = " + std::to_string(D) + (law ? " " + law->name : ""));
  Sample<D> sample = many_grains<D>();
  Scene scene = sheared_scene<D>(0.3, 1);
  if (law) {
    law->change(scene);
    mix_materials<D>(scene, sample);
  }
  const auto plain = make_engine<D>(EngineKind::md, scene, sample);
  const auto other = make_engine<D>(EngineKind::md, scene, sample);
  plain->advance(150);
  Archive archive, elsewhere, again;
  plain->save(archive);
  elsewhere = archive;
  const std::vector<int> order = shuffled(sample.count(), 11);
  elsewhere.integers["md.order"].assign(order.begin(), order.end());
  other->restore(elsewhere);
  expect_same_grains<D>(plain->snapshot(), other->snapshot());
  expect_same_contacts<D>(plain->snapshot(), other->snapshot());
  EXPECT_NEAR(other->energy().total(), plain->energy().total(), 1e-12 * std::abs(plain->energy().total()));

  // There and back: to the last bit.
  elsewhere = {};
  other->save(elsewhere);
  EXPECT_NE(elsewhere.integers.at("neighbours.pairs"), archive.integers.at("neighbours.pairs"));
  elsewhere.integers["md.order"] = archive.integers.at("md.order");
  const auto third = make_engine<D>(EngineKind::md, scene, sample);
  third->restore(elsewhere);
  third->save(again);
  EXPECT_EQ(again.reals, archive.reals);
  EXPECT_EQ(again.integers, archive.integers);

  // Springs that had lost their signs would show at once; sums in another order differ by rounding, which contacts that
  // open and close multiply. 40 steps are less than a collision.
  plain->advance(40), other->advance(40);
  const Snapshot<D> expected = plain->snapshot(), found = other->snapshot();
  for (int i = 0; i < sample.count(); ++i) {
    ASSERT_LT((found.velocity[i] - expected.velocity[i]).norm(), 1e-10) << i;
    ASSERT_LT(std::sqrt(squared(Spin<D>(found.spin[i] - expected.spin[i]))), 1e-10) << i;
  }
}

TEST(restart, InAnotherOrderOfTheMemory) {
  check_carried<2>(nullptr);
  check_carried<3>(nullptr);
}
TEST(restart, InAnotherOrderOfTheMemoryWithAnyLaw) {
  for (const RichLaw& law : rich_laws()) check_carried<2>(&law), check_carried<3>(&law);
}

/// A flow that is sheared so fast that its order decays within the test.
std::unique_ptr<Engine<2>> fast_flow() {
  Sample<2> sample = many_grains<2>();
  return make_engine<2>(EngineKind::md, sheared_scene<2>(4, 1), renumbered<2>(sample, shuffled(sample.count(), 3)));
}

TEST(restart, AcrossAChangeOfTheOrder) {
  const auto whole = fast_flow();
  Archive start, before, after;
  whole->save(start);
  // The first change within the run, and a state shortly before.
  long steps = 0;
  const long stride = 20;
  before = start;
  for (; steps < 6000; steps += stride) {
    whole->advance(stride);
    whole->save(after);
    if (order_of(after) != order_of(start)) break;
    before = after;
  }
  ASSERT_NE(order_of(after), order_of(start)) << "the order has not decayed";
  EXPECT_GT(steps, 0);

  const auto resumed = fast_flow();
  resumed->restore(before);
  resumed->advance(stride);
  EXPECT_EQ(hash_of<2>(*resumed), hash_of<2>(*whole));
  expect_same_contacts<2>(resumed->snapshot(), whole->snapshot());
  whole->advance(201);
  resumed->restore(after);
  resumed->advance(201);
  EXPECT_EQ(hash_of<2>(*resumed), hash_of<2>(*whole));

  const ThreadCount threads_back;
  set_thread_count(2);
  const auto on_two = fast_flow();
  on_two->restore(before);
  on_two->advance(stride + 201);
  EXPECT_EQ(hash_of<2>(*on_two), hash_of<2>(*whole));
}

TEST(GrainOrder, MessagesNameGrainsByTheirNumbers) {
  Sample<2> sample = many_grains<2>();
  sample = renumbered<2>(sample, shuffled(sample.count(), 5));
  sample.position[1000] = sample.position[17] + Vec<2>(0.1, 0);
  // Others overlap with the grain that was moved, too, but none as much: take them out of its way.
  for (int i = 0; i < sample.count(); ++i)
    if (i != 17 && i != 1000) sample.radius[i] = 0.05;
  try {
    make_engine<2>(EngineKind::md, sheared_scene<2>(0.3, 1), sample);
    FAIL() << "two grains lie in each other";
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("grains 17 and 1000 overlap"), std::string::npos) << error.what();
  }
}

TEST(GrainOrder, IsSortedAnewWhenPairsLieFartherApart) {
  constexpr int count = md::least_sorted_grains;
  md::GrainOrder<2> order;
  order.start(count);
  EXPECT_TRUE(order.decayed());  // never sorted
  const auto chain = [&](int apart) {
    PairColumns<2> pairs;
    for (int i = 0; i + apart < count; ++i)
      pairs.i.push_back(i), pairs.j.push_back(i + apart), pairs.image.push_back({});
    return pairs;
  };
  order.look_at(chain(4));  // 3 bits
  EXPECT_FALSE(order.decayed());
  order.look_at(chain(2));  // 2 bits: the least from now on
  EXPECT_FALSE(order.decayed());
  PairColumns<2> mixed = chain(2);
  for (std::size_t k = 0; k < mixed.size(); k += 4) mixed.j[k] = std::min(count - 1, mixed.i[k] + 4);
  order.look_at(mixed);  // a quarter of the pairs twice as far apart: 2.25 bits
  EXPECT_FALSE(order.decayed());
  order.look_at(chain(4));
  EXPECT_TRUE(order.decayed());

  // Grains along a line, numbered at random, come to lie along it.
  std::vector<Vec<2>> position;
  const std::vector<int> shuffle = shuffled(count, 9);
  for (const int k : shuffle) position.push_back(Vec<2>(k + 0.5, 0.5));
  const Cell<2> cell = cube<2>(count, true);
  Permutation step = order.sorted(cell, position);
  step.apply(position);
  order.moved(step);
  for (int k = 0; k < count; ++k) {
    EXPECT_EQ(position[k].x(), k + 0.5);
    EXPECT_EQ(shuffle[order.number()[k]], k);
  }
}

TEST(Permutation, MovesAlongItsCycles) {
  const std::vector<int> order = shuffled(100, 13);
  Permutation step;
  step.set(order);
  std::vector<int> values(100);
  std::iota(values.begin(), values.end(), 0);
  std::vector<double> groups;
  for (int k = 0; k < 100; ++k) groups.insert(groups.end(), {1.0 * k, 2.0 * k, 3.0 * k});
  step.apply(values);
  step.apply(groups.data(), 3);
  EXPECT_EQ(values, order);
  for (int k = 0; k < 100; ++k) {
    EXPECT_EQ(step.from(step.to(k)), k);
    for (int a = 0; a < 3; ++a) EXPECT_EQ(groups[3 * k + a], (a + 1.0) * order[k]);
  }
  EXPECT_FALSE(step.identity());
  std::sort(values.begin(), values.end());
  step.set(values);
  EXPECT_TRUE(step.identity());
  values[3] = 4;
  EXPECT_THROW(step.set(values), std::exception);
}

}  // namespace
}  // namespace galet::test::grain_order_test
