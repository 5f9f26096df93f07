// What a snapshot of md shows, by the user's numbers of the grains: copies of what md keeps in an order of its own
// (md/grain_order.hpp). Where both orders are the same nothing is copied.
#pragma once

#include <algorithm>
#include <numeric>
#include <span>
#include <vector>

#include "common/core/column.hpp"
#include "common/core/permutation.hpp"
#include "common/engine/bodies.hpp"
#include "common/engine/snapshot.hpp"
#include "common/neighbour/image.hpp"

namespace galet::md {

template <Layout Y>
class Shown {
 public:
  static constexpr int D = Y.dim;

  ContactColumns<D> contacts;

  std::size_t bytes() const { return bytes_of(position_, velocity_, radius_, mass_, spin_, body_of_, arm_); }

  /// Shows the grains of `bodies`, of which the k-th has number[k].
  void show_grains(const Bodies<Y>& bodies, std::span<const int> number, Snapshot<D>& shown) {
    put(bodies.position, number, position_), put(bodies.velocity, number, velocity_);
    put(bodies.radius, number, radius_), put(bodies.mass, number, mass_);
    if (!bodies.rigid.none()) {
      put(bodies.rigid.of, number, body_of_), put(bodies.arm, number, arm_);
      shown.body_of = body_of_, shown.arm = arm_;
    }
    shown.position = position_, shown.velocity = velocity_, shown.radius = radius_, shown.mass = mass_;
    if constexpr (Y.friction) {
      put(bodies.spin, number, spin_);
      shown.spin = spin_;
    }
  }

  /// Gives the contacts the user's numbers and sorts them by these. The k-th grain has number[k].
  void number_contacts(std::span<const int> number) {
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const bool plane = contacts.j[c] >= static_cast<int>(number.size());
      contacts.i[c] = number[contacts.i[c]];
      if (plane) continue;
      contacts.j[c] = number[contacts.j[c]];
      if (contacts.j[c] < contacts.i[c]) turn(c);
    }
    order_.resize(contacts.size());
    std::iota(order_.begin(), order_.end(), 0);
    std::sort(order_.begin(), order_.end(), [this](int a, int b) {
      if (contacts.i[a] != contacts.i[b]) return contacts.i[a] < contacts.i[b];
      if (contacts.j[a] != contacts.j[b]) return contacts.j[a] < contacts.j[b];
      return contacts.image[a] < contacts.image[b];
    });
    sorting_.set(order_);
    const auto sort = [this](auto& column) {
      if (!column.empty()) sorting_.apply(column);
    };
    sort(contacts.i), sort(contacts.j), sort(contacts.image);
    sort(contacts.normal), sort(contacts.branch), sort(contacts.gap);
    sort(contacts.force), sort(contacts.torque), sort(contacts.touching), sort(contacts.mobilised);
  }

 private:
  /// The same contact seen from its other grain.
  void turn(std::size_t c) {
    std::swap(contacts.i[c], contacts.j[c]);
    contacts.image[c] = negative<D>(contacts.image[c]);
    contacts.normal[c] *= -1, contacts.branch[c] *= -1, contacts.force[c] *= -1;
    if (!contacts.torque.empty()) contacts.torque[c] *= -1;
  }

  template <class Values>
  static void put(const Values& from, std::span<const int> number, Values& to) {
    to.resize(from.size());
    for (std::size_t k = 0; k < from.size(); ++k) to[number[k]] = from[k];
  }

  Column<Vec<D>> position_, velocity_;
  Column<double> radius_, mass_;
  Column<Spin<D>, true> spin_;
  std::vector<int> body_of_;
  std::vector<Vec<D>> arm_;
  std::vector<int> order_;
  Permutation sorting_;
};

}  // namespace galet::md
