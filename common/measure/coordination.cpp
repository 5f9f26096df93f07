#include "common/measure/coordination.hpp"

namespace galet {

namespace {

/// Grains met by each grain's contacts, row by row (compressed rows). A plane is a neighbour that is never removed:
/// it appears in the degree only. A contact of a grain with its own image gives two entries.
struct Neighbours {
  std::vector<int> degree;  ///< contacts of each grain
  std::vector<int> first;   ///< first entry of each grain's row
  std::vector<int> grain;
};

template <int D>
Neighbours neighbours(const ContactColumns<D>& contacts, int grains) {
  Neighbours rows;
  rows.degree.assign(grains, 0);
  rows.first.assign(grains + 1, 0);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (!contacts.touches(c)) continue;
    const int i = contacts.i[c], j = contacts.j[c];
    ++rows.degree[i];
    if (j >= grains) continue;
    ++rows.degree[j];
    ++rows.first[i + 1];
    ++rows.first[j + 1];
  }
  for (int k = 0; k < grains; ++k) rows.first[k + 1] += rows.first[k];
  rows.grain.resize(rows.first[grains]);
  std::vector<int> next(rows.first.begin(), rows.first.end() - 1);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const int i = contacts.i[c], j = contacts.j[c];
    if (j >= grains || !contacts.touches(c)) continue;
    rows.grain[next[i]++] = j;
    rows.grain[next[j]++] = i;
  }
  return rows;
}

}  // namespace

template <int D>
std::vector<char> rattlers(const Snapshot<D>& snapshot, bool friction) {
  const int grains = snapshot.grains(), least = friction ? 2 : D + 1;
  Neighbours rows = neighbours(*snapshot.contacts, grains);
  std::vector<char> rattler(grains, 0);
  std::vector<int> removed;  // rattlers whose neighbours have not been told yet
  const auto remove_if_loose = [&](int k) {
    if (rattler[k] || rows.degree[k] >= least) return;
    rattler[k] = 1;
    removed.push_back(k);
  };
  for (int k = 0; k < grains; ++k) remove_if_loose(k);
  while (!removed.empty()) {
    const int gone = removed.back();
    removed.pop_back();
    for (int entry = rows.first[gone]; entry < rows.first[gone + 1]; ++entry) {
      --rows.degree[rows.grain[entry]];
      remove_if_loose(rows.grain[entry]);
    }
  }
  return rattler;
}

template <int D>
Coordination coordination(const Snapshot<D>& snapshot, bool friction) {
  const ContactColumns<D>& contacts = *snapshot.contacts;
  const int grains = snapshot.grains();
  Coordination result;
  if (grains == 0) return result;

  const std::vector<char> rattler = rattlers(snapshot, friction);
  long ends = 0, backbone_ends = 0, backbone_grains = 0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (!contacts.touches(c)) continue;
    ++result.contacts;
    const int i = contacts.i[c], j = contacts.j[c];
    const int ends_here = j < grains ? 2 : 1;  // a plane is no grain: its end does not count
    ends += ends_here;
    if (!rattler[i] && (j >= grains || !rattler[j])) backbone_ends += ends_here;
  }
  for (char loose : rattler) backbone_grains += loose ? 0 : 1;
  result.z = static_cast<double>(ends) / grains;
  if (backbone_grains > 0) result.z_star = static_cast<double>(backbone_ends) / static_cast<double>(backbone_grains);
  result.rattler_fraction = static_cast<double>(grains - backbone_grains) / grains;
  return result;
}

template Coordination coordination<2>(const Snapshot<2>&, bool);
template Coordination coordination<3>(const Snapshot<3>&, bool);
template std::vector<char> rattlers<2>(const Snapshot<2>&, bool);
template std::vector<char> rattlers<3>(const Snapshot<3>&, bool);

}  // namespace galet
