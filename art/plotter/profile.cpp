#include "art/plotter/profile.h"

#include "art/style/length.h"
#include "engine/base/input_file.h"
#include "engine/base/option.h"
#include "engine/base/text.h"
#include "engine/language/pattern.h"

#include <embedded/plotter_profiles.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <stdexcept>
#include <system_error>

namespace sikku {
namespace {

constexpr std::size_t most_bytes = 65536;
constexpr double dpi = 96;  // resolution of lengths in px

const std::array<BundledProfile, 7> bundled = {{{"axidraw", axidraw_plotter},
                                                {"grbl", grbl_plotter},
                                                {"grbl-laser", grbl_laser_plotter},
                                                {"hp7475a", hp7475a_plotter},
                                                {"marlin", marlin_plotter},
                                                {"marlin-z", marlin_z_plotter},
                                                {"z", z_plotter}}};

using P = PlotterProfile;
using Text = const std::string&;

[[noreturn]] void fail(const std::string& message) {
    throw std::runtime_error(message);
}

bool is_yes(Text text) {
    if (text != "yes" && text != "no") fail("expected yes or no");
    return text == "yes";
}

double length_of(Text text) {
    const auto value = parse_length(text, dpi);
    if (!value || !(*value >= 0 && *value <= 1e4)) fail("expected a length such as 0.5mm, up to 10 m");
    return *value;
}

void add_line(std::string& lines, Text line) {
    lines += (lines.empty() ? "" : "\n") + line;
}

/// A key of profiles. `set` throws std::runtime_error for a value that cannot be read.
struct ProfileKey {
    std::string_view name;
    std::string_view languages;  ///< languages to which it applies: g, h, s
    void (*set)(P& profile, Text text);
    bool is_list = false;  ///< may be repeated
};

const std::array<ProfileKey, 25> profile_keys = {{
    {"title", "ghs", [](P& p, Text t) { p.title = t; }},
    {"language", "ghs",
     [](P& p, Text t) {
         for (const PlotLanguage language : {PlotLanguage::gcode, PlotLanguage::hpgl, PlotLanguage::svg}) {
             if (lower_case(t) != lower_case(language_name(language))) continue;
             p.language = language;
             return;
         }
         fail("expected G-code, HP-GL or SVG");
     }},
    {"speed", "ghs", [](P& p, Text t) { p.speeds.drawing = parse_speed(t); }},
    {"travel speed", "ghs", [](P& p, Text t) { p.speeds.travelling = parse_speed(t); }},
    {"lift time", "ghs", [](P& p, Text t) { p.speeds.lift = parse_pause(t); }},
    {"pen", "ghs", [](P& p, Text t) { p.rules.push_back(parse_pen_rule(t, dpi)); }, true},
    {"pens", "gh",
     [](P& p, Text t) {
         double value = 0;
         if (!read_number(t, value) || !(value >= 1 && value <= 256) || value != static_cast<int>(value)) {
             fail("expected a number of pens, 1 to 256");
         }
         p.pens = static_cast<int>(value);
     }},
    {"park", "gh", [](P& p, Text t) { p.park = parse_place(t, dpi); }},
    {"paper", "h",
     [](P& p, Text t) {
         p.paper = parse_hpgl_paper(t, dpi);
         if (!p.paper) fail("expected A4, A3, letter or tabloid, or the limits of the plotter: 400x276mm[,centre]");
     }},
    {"unit", "h",
     [](P& p, Text t) {
         p.unit = length_of(t);
         if (!(p.unit >= 0.001 && p.unit <= 1)) fail("expected the length of a plotter unit, 0.001mm to 1mm");
     }},
    {"full speed", "s", [](P& p, Text t) { p.layers.full_speed = parse_speed(t); }},
    {"pause between pens", "s", [](P& p, Text t) { p.layers.pauses = is_yes(t); }},
    {"setup", "g", [](P& p, Text t) { add_line(p.gcode.setup, t); }, true},
    {"start", "g", [](P& p, Text t) { add_line(p.gcode.start, t); }, true},
    {"end", "g", [](P& p, Text t) { add_line(p.gcode.end, t); }, true},
    {"pen up", "g", [](P& p, Text t) { add_line(p.gcode.pen_up, t); }, true},
    {"pen down", "g", [](P& p, Text t) { add_line(p.gcode.pen_down, t); }, true},
    {"pen change", "g", [](P& p, Text t) { add_line(p.gcode.pen_change, t); }, true},
    {"dwell", "g", [](P& p, Text t) { add_line(p.gcode.dwell, t); }, true},
    {"comments", "g",
     [](P& p, Text t) {
         if (t != "(" && t != ";" && t != "()") fail("expected ( or ;");
         p.gcode.comment = t.front();
     }},
    {"lift", "g", [](P& p, Text t) { p.gcode.lift = parse_height(t); }},
    {"down", "g", [](P& p, Text t) { p.gcode.down = parse_height(t); }},
    {"pause", "g", [](P& p, Text t) { p.gcode.pause = parse_pause(t); }},
    {"arcs", "g", [](P& p, Text t) { p.gcode.arcs = is_yes(t); }},
    {"minimum arc", "g", [](P& p, Text t) { p.gcode.least_arc = length_of(t); }},
}};

char letter_of(PlotLanguage language) {
    return language == PlotLanguage::gcode ? 'g' : language == PlotLanguage::hpgl ? 'h' : 's';
}

/// A line `key: value`.
struct ProfileLine {
    const ProfileKey* key;
    Span name, value;
};

std::vector<ProfileLine> lines_of(const SourcePointer& source, Diagnostics& diagnostics) {
    std::vector<ProfileLine> lines;
    std::set<std::string_view> seen;
    const std::string_view text = source->cleaned();
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        const Span line = Span(source, begin, end - begin).trimmed();
        begin = end + 1;
        if (line.empty()) continue;
        const std::size_t colon = line.view().find(':');
        if (colon == std::string_view::npos) {
            diagnostics.error(line, "expected a key and its value, such as 'pen up: M5'");
            continue;
        }
        const Span name = line.part(0, colon).trimmed();
        const Span value = line.part(colon + 1).trimmed();
        const auto key = std::find_if(profile_keys.begin(), profile_keys.end(),
                                      [&](const ProfileKey& known) { return known.name == lower_case(name.view()); });
        if (key == profile_keys.end()) {
            std::vector<std::string_view> names;
            names.reserve(profile_keys.size());
            for (const ProfileKey& known : profile_keys) names.push_back(known.name);
            diagnostics.error(name, fmt::format("unknown key '{}' of a plotter{}", printable(name.view(), 40),
                                                did_you_mean(nearest(name.view(), names))));
        } else if (value.empty()) {
            diagnostics.error(line, fmt::format("the value of '{}' is missing", key->name));
        } else if (!seen.insert(key->name).second && !key->is_list) {
            diagnostics.error(name, fmt::format("'{}' is set twice", key->name));
        } else {
            lines.push_back({&*key, name, value});
        }
    }
    return lines;
}

/// Checks the placeholders of a command.
void check_placeholders(const Span& value, Diagnostics& diagnostics) {
    const std::string_view text = value.view();
    for (std::size_t at = text.find('{'); at != std::string_view::npos; at = text.find('{', at + 1)) {
        const std::size_t close = text.find('}', at);
        const std::size_t end = close == std::string_view::npos ? text.size() : close;
        const std::string_view name = text.substr(at + 1, end - at - 1);
        constexpr std::array<std::string_view, 6> known = {"lift",   "down",    "pen",
                                                           "colour", "seconds", "milliseconds"};
        if (close != std::string_view::npos && std::find(known.begin(), known.end(), name) != known.end()) continue;
        diagnostics.error(value.part(at, end + 1 - at),
                          fmt::format("unknown placeholder {{{}}}; expected {{lift}}, {{down}}, {{pen}}, {{colour}}, "
                                      "{{seconds}} or {{milliseconds}}",
                                      printable(name, 40)));
        return;
    }
}

/// Checks the places to which G-code moves.
void check_places(const Span& value, Diagnostics& diagnostics) {
    const std::string_view word = unreachable_word(value.view());
    if (word.empty()) return;
    diagnostics.error(value.part(static_cast<std::size_t>(word.data() - value.view().data()), word.size()),
                      "expected a place within 10 m of the origin");
}

}  // namespace

std::string_view language_name(PlotLanguage language) {
    return language == PlotLanguage::gcode ? "G-code" : language == PlotLanguage::hpgl ? "HP-GL" : "SVG";
}

PlotterProfile parse_profile(const std::string& name, const std::string& text) {
    Diagnostics diagnostics;
    const SourcePointer source = read_source(name, text, diagnostics);
    diagnostics.throw_if_errors();
    PlotterProfile profile;
    profile.name = name;
    const std::vector<ProfileLine> lines = lines_of(source, diagnostics);
    const auto is = [](std::string_view key) {
        return [key](const ProfileLine& line) { return line.key->name == key; };
    };
    const auto apply = [&](const ProfileLine& line) {
        try {
            line.key->set(profile, std::string(line.value.view()));
        } catch (const std::runtime_error& error) {
            diagnostics.error(line.value, error.what());
        }
    };
    const auto language = std::find_if(lines.begin(), lines.end(), is("language"));
    if (language == lines.end()) {
        diagnostics.error(Span(source, 0, 0), "the language of the plotter is missing: G-code, HP-GL or SVG");
    } else {
        apply(*language);
    }
    // Commands that the profile contains replace those of the default.
    GcodeOptions& gcode = profile.gcode;
    const std::array<std::pair<std::string_view, std::string*>, 6> commands = {{{"setup", &gcode.setup},
                                                                                {"end", &gcode.end},
                                                                                {"pen up", &gcode.pen_up},
                                                                                {"pen down", &gcode.pen_down},
                                                                                {"pen change", &gcode.pen_change},
                                                                                {"dwell", &gcode.dwell}}};
    for (const auto& [key, value] : commands) {
        if (std::any_of(lines.begin(), lines.end(), is(key))) value->clear();
    }
    for (const ProfileLine& line : lines) {
        if (line.key->name == "language") continue;
        if (language != lines.end() && line.key->languages.find(letter_of(profile.language)) == std::string::npos) {
            diagnostics.error(line.name, fmt::format("'{}' does not apply to a plotter that reads {}", line.key->name,
                                                     language_name(profile.language)));
            continue;
        }
        if (line.key->name.starts_with("pen ") || line.key->name == "dwell") {
            check_placeholders(line.value, diagnostics);
        }
        if (line.key->languages == "g") check_places(line.value, diagnostics);
        apply(line);
    }
    diagnostics.throw_if_errors();
    return profile;
}

PlotterProfile read_profile(const std::filesystem::path& file) {
    std::error_code error;
    if (std::filesystem::is_fifo(file, error)) {
        throw std::runtime_error(fmt::format("'{}' is a pipe; expected a file", file.string()));
    }
    std::string text = read_file(file, file.string(), most_bytes);
    if (text.size() > most_bytes) {
        throw std::runtime_error(
            fmt::format("'{}' is larger than 64 kB, the limit for profiles of plotters", file.string()));
    }
    return parse_profile(file.string(), text);
}

std::span<const BundledProfile> bundled_profiles() {
    return bundled;
}

std::optional<PlotterProfile> bundled_profile(std::string_view name) {
    for (const BundledProfile& profile : bundled) {
        if (profile.name == name) return parse_profile(std::string(name), std::string(profile.text));
    }
    return std::nullopt;
}

bool is_profile_file(std::string_view text) {
    return text.find_first_of("./") != std::string_view::npos;
}

void check_profile(const PlotterProfile& profile, PrintFormat format) {
    const auto refuse = [&](const std::string& why) { refuse_option("profile", profile.name, why); };
    const PlotLanguage spoken = format == PrintFormat::hpgl    ? PlotLanguage::hpgl
                                : format == PrintFormat::gcode ? PlotLanguage::gcode
                                                               : PlotLanguage::svg;
    if (is_for_plotters(format) && profile.language != spoken) {
        refuse(fmt::format("this plotter reads {}, not {}", language_name(profile.language), language_name(spoken)));
    }
    if (profile.language != PlotLanguage::svg || format == PrintFormat::svg || format == PrintFormat::dxf) return;
    refuse(is_vector(format) ? fmt::format("this plotter reads SVG, not {}", info(format).label) : plot_formats);
}

void check_pen_rules(std::span<const PenRule> rules, const LayerCodes& codes, PrintFormat format) {
    const bool has_codes = codes.full_speed > 0 && format == PrintFormat::svg;
    const auto refuse_if = [](bool is_wrong, const char* why) {
        if (is_wrong) refuse_option("pen", "", why);
    };
    for (const PenRule& rule : rules) {
        const PenSettings& pen = rule.settings;
        const bool has_height = pen.lift || pen.down || pen.pause;
        refuse_if(format == PrintFormat::hpgl && has_height, "HP-GL sets the speed of a pen, but not its height");
        refuse_if(has_codes && pen.lift, "the names of AxiDraw's layers do not contain the height of a raised pen");
        refuse_if(!is_for_plotters(format) && !has_codes && (has_height || pen.speed),
                  "an SVG describes pens only in layer names for AxiDraw; 'profile' axidraw writes them");
    }
}

}  // namespace sikku
