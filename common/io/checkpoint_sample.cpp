#include "common/io/checkpoint_sample.hpp"

#include <algorithm>
#include <filesystem>

#include "common/core/archive_columns.hpp"
#include "common/core/error.hpp"
#include "common/io/checkpoint.hpp"

namespace galet {

Archive initial_checkpoint(const Scene& scene) {
  return read_checkpoint((std::filesystem::path(scene.directory) / scene.initial.file).string());
}

template <int D>
Sample<D> checkpoint_sample(const Archive& archive) {
  const std::vector<double>& box = real_column(archive, "cell.box");
  if (box.size() != D * D) throw InputError("initial.file: the checkpoint is of another dimension than the scene");
  const auto& body = integer_column(archive, "sample.body");
  if (std::any_of(body.begin(), body.end(), [](std::int64_t b) { return b >= 0; }))
    throw InputError("initial.file: the checkpoint holds rigid bodies, which can't start another scene");
  Sample<D> sample;
  sample.resize(static_cast<int>(real_column(archive, "grains.radius").size()));
  sample.cell.box = Eigen::Map<const Mat<D>>(box.data());
  const auto& periodic = integer_column(archive, "sample.periodic");
  if (periodic.size() != D) throw InputError("initial.file: the checkpoint is damaged: column 'sample.periodic'");
  for (int a = 0; a < D; ++a) sample.cell.periodic[a] = periodic[a] != 0;
  take_column(archive, "grains.position", sample.position);
  take_column(archive, "grains.velocity", sample.velocity);
  take_column(archive, "grains.radius", sample.radius);
  take_column(archive, "grains.mass", sample.mass);
  if (archive.reals.contains("grains.spin")) take_column(archive, "grains.spin", sample.spin);
  const auto& material = integer_column(archive, "sample.material");
  std::copy_n(material.begin(), std::min(material.size(), sample.material.size()), sample.material.begin());
  return sample;
}

template Sample<2> checkpoint_sample<2>(const Archive&);
template Sample<3> checkpoint_sample<3>(const Archive&);

}  // namespace galet
