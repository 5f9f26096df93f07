#include "tests/support/checkpoint_mutations.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "common/core/error.hpp"
#include "common/core/random.hpp"
#include "common/io/checkpoint.hpp"
#include "src/simulation.hpp"
#include "tests/support/temporary_folder.hpp"

namespace galet::test {

namespace {

constexpr std::uint64_t damage_seed = 4711;

constexpr const char* scene = R"(grains.count = 12
material = {friction = 0.4, restitution = 0.1, stiffness_level = 1e3}
initial = {kind = "gas", solid_fraction = 0.5}
loading = {kind = "plane_shear", pressure = 1, inertial_number = 0.2}
run = {duration = 2, samples = 10}
)";

std::size_t number_below(RandomStream& random, std::size_t count) {
  return std::min(count - 1, static_cast<std::size_t>(random.uniform() * static_cast<double>(count)));
}

/// One kind of damage that disks, cables and programs do.
std::string damage(std::string& bytes, RandomStream& random) {
  const std::size_t place = number_below(random, bytes.size()), length = 1 + number_below(random, 600);
  switch (number_below(random, 7)) {
    case 0:
    case 1:
      bytes[place] = static_cast<char>(bytes[place] ^ (1 << number_below(random, 8)));
      return fmt::format("a bit of byte {}", place);
    case 2:
      bytes.resize(place);
      return fmt::format("cut at {}", place);
    case 3:
      std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(place), std::min(length, bytes.size() - place), '\0');
      return fmt::format("{} zeros at {}", length, place);
    case 4:
      bytes.erase(place, length);
      return fmt::format("{} bytes taken out at {}", length, place);
    case 5:
      bytes.insert(place, std::string(length, static_cast<char>(number_below(random, 256))));
      return fmt::format("{} bytes put in at {}", length, place);
    default:
      std::swap(bytes[place], bytes[number_below(random, bytes.size())]);
      return fmt::format("byte {} swapped", place);
  }
}

void read_one(const std::string& path, const std::string& what, const Archive& sound, DamageCounts& counts) {
  try {
    const Archive read = read_checkpoint(path);
    // The hash covers every bit of the numbers; texts are compared by themselves.
    if (state_hash(read) == state_hash(sound) && read.texts == sound.texts)
      ++counts.same;
    else
      counts.complaints.push_back(what + ": read, with other bits");
  } catch (const InputError& error) {
    ++counts.refused;
    if (std::string(error.what()).find(path) == std::string::npos)
      counts.complaints.push_back(what + ": the message doesn't name the file: " + error.what());
  } catch (const std::exception& error) {
    counts.complaints.push_back(what + ": not an input error: " + error.what());
  }
}

}  // namespace

DamageCounts read_damaged_checkpoints(long first, long count) {
  Simulation<2> simulation(parse_scene(scene, "scene.toml"), EngineKind::md);
  simulation.run();
  const Archive sound = simulation.checkpoint();
  const TemporaryFolder folder;
  const std::string path = folder.file("a.h5");
  write_checkpoint(path, sound);
  const std::string good = file_bytes(path);
  DamageCounts counts;
  for (long k = first; k < first + count && counts.complaints.size() < 10; ++k) {
    RandomStream random(damage_seed, static_cast<std::uint64_t>(k));
    std::string bytes = good, what;
    while (bytes == good) what = damage(bytes, random);  // zeros over zeros are no damage
    put_bytes(path, bytes);
    read_one(path, what, sound, counts);
  }
  return counts;
}

}  // namespace galet::test
