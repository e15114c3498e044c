// python/kolams.h: kolams made on grids of dots, and read from photographs and other files.
#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sikku {

/// Makes a kolam. Returns (text of the pattern, facts as JSON). Arguments are those of `sikku kolam --grid`.
/// @throws SettingError, std::runtime_error
pybind11::tuple make_kolam(const std::string& dots, std::uint64_t seed, const std::optional<std::string>& symmetry,
                           std::optional<double> density, double joined, const std::optional<std::string>& crossings,
                           std::uint32_t period, bool is_single_line, int attempts, bool is_coloured, bool draws_dots,
                           bool is_centred, const std::string& rim);

/// The text of the pattern of a radial kolam. @throws SettingError
pybind11::str make_radial_kolam(const std::string& size, const std::string& order, bool is_coloured, bool draws_dots);

/// Reads a kolam. Returns (text of the pattern, facts as JSON). Arguments are those of `sikku kolam --read`.
/// @throws SettingError, NotFound, std::runtime_error, PatternError
pybind11::tuple read_kolam(const std::string& path, std::size_t number, const std::string& lattice,
                           const std::string& grid, const std::string& corners, const std::string& crop, bool repairs,
                           const std::vector<std::string>& fixes, double budget);

}  // namespace sikku
