// The parts that the field table (scene_fields.hpp) is put together from.
#pragma once

#include <vector>

#include "common/io/scene_fields.hpp"

namespace galet::scene_table {

using Rows = std::vector<SceneField>;

inline Interval above(double low) { return {.low = low, .low_open = true}; }
inline Interval at_least(double low) { return {.low = low}; }
inline Interval between(double low, double high) { return {.low = low, .high = high}; }

// scene_table_boundaries.cpp
void add_boundaries(Rows& rows);

// scene_table_bodies.cpp
void add_bodies(Rows& rows);

// scene_table_material.cpp
void add_material(Rows& rows);
void add_other_materials(Rows& rows);
void add_pairs(Rows& rows);
void add_groups(Rows& rows);

// scene_table_loading.cpp
void add_loading(Rows& rows);
void add_drives(Rows& rows);
void add_stages(Rows& rows);
void add_run(Rows& rows);

// scene_table_output.cpp
void add_output(Rows& rows);
void add_guard(Rows& rows);

}  // namespace galet::scene_table
