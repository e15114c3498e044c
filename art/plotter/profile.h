// art/plotter/profile.h: plotters described by small text files.
#pragma once

#include "art/plotter/gcode.h"
#include "art/plotter/hpgl.h"
#include "art/plotter/pen_rules.h"
#include "art/plotter/plot_options.h"
#include "art/print/format.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

enum class PlotLanguage : std::uint8_t { gcode, hpgl, svg };
/// Returns `G-code`, `HP-GL` or `SVG`.
std::string_view language_name(PlotLanguage language);

/// A plotter: its language, its speeds, and how it moves its pens.
struct PlotterProfile {
    std::string name;   ///< `grbl`, or the file
    std::string title;  ///< for people
    PlotLanguage language = PlotLanguage::gcode;
    PlotSpeeds speeds{};
    GcodeOptions gcode{};              ///< commands and heights; only G-code
    std::optional<HpglPaper> paper{};  ///< only HP-GL
    double unit = hpgl_unit;           ///< millimetres of a plotter unit; only HP-GL
    int pens = 0;                      ///< number of pens it holds; 0: any
    std::vector<PenRule> rules{};
    std::optional<glm::dvec2> park{};  ///< place of the pen while it is changed
    LayerCodes layers{};               ///< only SVG
};

/// Parses the text of a profile: lines `key: value`, with comments as in patterns. Keys that take commands may be
/// repeated, one command a line.
/// @throws PatternError, with every error and its place
PlotterProfile parse_profile(const std::string& name, const std::string& text);
/// Reads a profile. @throws std::runtime_error if the file cannot be read or exceeds 64 kB; PatternError
PlotterProfile read_profile(const std::filesystem::path& file);

/// @throws SettingError if the plotter does not read the format
void check_profile(const PlotterProfile& profile, PrintFormat format);
/// @throws SettingError if the format, or layers with names of these codes, cannot express the settings of pens
void check_pen_rules(std::span<const PenRule> rules, const LayerCodes& codes, PrintFormat format);
/// The reason that a picture is not a plot.
inline constexpr const char* plot_formats = "a plot is SVG, PDF, EPS, HP-GL, G-code or DXF";

/// A bundled profile.
struct BundledProfile {
    std::string_view name;
    std::string_view text;
};
/// All bundled profiles, sorted by name.
std::span<const BundledProfile> bundled_profiles();
/// The bundled profile of that name, or nullopt.
std::optional<PlotterProfile> bundled_profile(std::string_view name);
/// True if `text` names a file rather than a bundled profile: if it contains a dot or a slash.
bool is_profile_file(std::string_view text);

}  // namespace sikku
