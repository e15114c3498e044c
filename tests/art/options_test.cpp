// Every option of prints, on several drawings and outputs, changes the file, is refused, or causes a warning: no
// accepted option is silently ignored.
#include "art/prints.h"
#include "engine/base/output.h"
#include "tests/print_tools.h"
#include "tests/reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace sikku::options_test {

struct Drawing {
    std::string name, text;
};

const std::vector<Drawing> drawings = {
    {"kolam",
     "title: Kolam\naxiom: F+XF+F+XF\nX --> XF-F-F+XF+F+XF-F-F+X\nderivation length: 1\nangle increment: 90\n"
     "stroke: 0.2 step #f2b632\nground: #8c3b2a\n"},
    {"tiling",
     "title: Squares\naxiom: {F+F+F+F}+f{F+F+F+F}\nF --> F\nderivation length: 1\nangle increment: 90\n"
     "stroke: 0.4mm #203060\nground: #ffffff\npalette: #203060 #304060\nfill: #30a050\n"},
    {"tree",
     "title: Tree\naxiom: F\nF --> F[+F]F[-F]F\nderivation length: 2\nangle increment: 25.7\nstroke: 0.4mm #203060\n"
     "ground: #ffffff\n"},
    {"solid",
     "title: Solid\naxiom: F\nF --> F[&F]F\nderivation length: 2\nangle increment: 40\nstroke: 0.2 step #203060\n"
     "ground: #ffffff\n"}};

struct Output {
    std::string name, format;
    OptionValues values{};
};

const std::vector<Output> outputs = {
    {"svg", "svg"},     {"pdf", "pdf"},   {"png", "png"}, {"plot", "svg", {{"plotter", "true"}}},
    {"gcode", "gcode"}, {"hpgl", "hpgl"}, {"dxf", "dxf"}, {"obj", "obj"},
    {"stl", "stl"}};

/// A value of each option that differs from its default. Options that only limit or speed up the work are left out.
const std::map<std::string, std::string> values = {{"size", "120x90mm"},
                                                   {"landscape", "true"},
                                                   {"margin", "7mm"},
                                                   {"compose", "true"},
                                                   {"step", "2mm"},
                                                   {"fill-page", "true"},
                                                   {"swatch", ""},
                                                   {"window", "-1,-1,2,2"},
                                                   {"rotate", "30"},
                                                   {"mirror", "true"},
                                                   {"view", "30 60"},
                                                   {"light", "sun"},
                                                   {"dots", "1mm"},
                                                   {"dot-spacing", "6mm"},
                                                   {"border", "kaavi"},
                                                   {"repeat", "p1:2x2"},
                                                   {"title-line", "Name"},
                                                   {"edition", "3/50"},
                                                   {"font", "Noto Serif"},
                                                   {"title-size", "6mm"},
                                                   {"title-weight", "bold"},
                                                   {"title-place", "above,centre"},
                                                   {"colour-by", "strand"},
                                                   {"generations", "0:1"},
                                                   {"highlight", "1"},
                                                   {"rule", "true"},
                                                   {"frames", "true"},
                                                   {"frame-time", "2"},
                                                   {"hold", "3"},
                                                   {"fit-frames", "true"},
                                                   {"animate", "5"},
                                                   {"divide", ""},
                                                   {"name-tiles", "true"},
                                                   {"kerf", "0.3mm"},
                                                   {"colouring", "0"},
                                                   {"lesson", ""},
                                                   {"tile", "60x60mm"},
                                                   {"overlap", "5mm"},
                                                   {"relief", "3mm"},
                                                   {"ridge", "1.5mm"},
                                                   {"base", "3mm"},
                                                   {"groove", "0.5mm"},
                                                   {"plotter", "true"},
                                                   {"profile", "axidraw"},
                                                   {"split", "20mm"},
                                                   {"pen-width", "0.2mm"},
                                                   {"hatch", "1mm,20"},
                                                   {"pens", "1"},
                                                   {"pen", "1 speed=9mm/s"},
                                                   {"refill", "100mm@1,1"},
                                                   {"park", "5,5"},
                                                   {"resume", "30mm"},
                                                   {"arcs", "false"},
                                                   {"min-arc", "30mm"},
                                                   {"hpgl-paper", "A3"},
                                                   {"travel", "true"},
                                                   {"pen-speed", "11"},
                                                   {"travel-speed", "22"},
                                                   {"lift-time", "0.7"},
                                                   {"gcode-start", "G54"},
                                                   {"gcode-end", "M30"},
                                                   {"bleed", "3mm"},
                                                   {"marks", "true"},
                                                   {"spot", "A=#8c3b2a"},
                                                   {"registration", "true"},
                                                   {"overprint", "black"},
                                                   {"bits", "1"},
                                                   {"screen", "diffusion"},
                                                   {"icc", "false"},
                                                   {"dpi", "90"},
                                                   {"compression", "1"},
                                                   {"line", "spline"},
                                                   {"hand", "0.5"},
                                                   {"stroke", "1mm #305070"},
                                                   {"ground", "#eeeedd"},
                                                   {"paper", "white"},
                                                   {"fill", "#a03050"},
                                                   {"palette", "#a03050 #3050a0"},
                                                   {"fields", "chessboard"},
                                                   {"tile-colours", "by shape"},
                                                   {"tile-edges", "border"},
                                                   {"decorate", "kolam"},
                                                   {"powders", "lotus"},
                                                   {"weave", "yes"},
                                                   {"parallel", "3"},
                                                   {"sway", "12"},
                                                   {"ground-plane", "none"},
                                                   {"cells", "splines"},
                                                   {"tension", "3"},
                                                   {"inset", "0.2"},
                                                   {"wall-width", "age"},
                                                   {"tissue", "#d0e0c0"}};

/// Options that need not change a file, with the reason.
const std::map<std::string, std::string> exempt = {
    {"fit", "the default"},
    {"budget", "a limit"},
    {"jobs", "speed only: files do not depend on threads"},
    {"cmyk", "needs a profile; refused or applied, see the tests of the press"}};

/// Combinations that should change nothing; empty: all drawings or outputs.
struct Exception {
    std::string option;
    std::set<std::string> drawings, outputs;
    std::string reason;
};
const std::vector<Exception> exceptions = {
    {"mirror", {"kolam", "tiling", "solid"}, {}, "the drawing is its own mirror image"},
    {"paper", {"tiling", "tree", "solid"}, {}, "these are on white paper in any case"},
    {"paper",
     {"kolam"},
     {"gcode", "hpgl", "dxf", "obj", "stl"},
     "the line is visible, and these formats have no ground"},
    {"plotter", {}, {"plot", "gcode", "hpgl", "dxf"}, "these are plots in any case"},
    {"decorate", {"tiling"}, {"stl"}, "dots lie within tiles of the same height"}};

bool is_exempt(const std::string& option, const std::string& drawing, const std::string& output) {
    return std::any_of(exceptions.begin(), exceptions.end(), [&](const Exception& one) {
        return one.option == option && (one.drawings.empty() || one.drawings.contains(drawing)) &&
               (one.outputs.empty() || one.outputs.contains(output));
    });
}

struct Result {
    std::map<std::string, std::string> files;
    std::string facts;
    std::vector<std::string> warnings;
};

/// The chunks of a PNG that are pixels, size or colours.
std::string without_texts(const std::string& png) {
    std::string kept;
    for (std::size_t at = 8; at + 12 <= png.size();) {
        std::size_t length = 0;
        for (std::size_t i = 0; i < 4; ++i) length = length << 8 | static_cast<unsigned char>(png[at + i]);
        const std::string kind = png.substr(at + 4, 4);
        if (kind != "tEXt" && kind != "iTXt" && kind != "zTXt") kept += png.substr(at, length + 12);
        at += length + 12;
    }
    return kept;
}

/// @throws SettingError, PatternError, std::runtime_error
Result make(const Drawing& drawing, const Output& output, const OptionValues& more) {
    OptionValues all = output.values;
    for (const OptionValue& value : more) {
        std::erase_if(all, [&](const OptionValue& one) { return one.name == value.name; });
        all.push_back(value);
    }
    for (const auto& [name, text] : {std::pair("size", "80x100mm"), std::pair("dpi", "60")}) {
        if (name == std::string("dpi") && output.format != "png") continue;
        if (std::none_of(all.begin(), all.end(), [&](const OptionValue& one) { return one.name == name; })) {
            all.push_back({name, text});
        }
    }
    MemoryDestination memory;
    const Made made = prints()
                          .plan(parse(drawing.name + ".lsys", drawing.text), output.format, all, {})
                          ->make(memory, "print." + output.format, {}, 1);
    Result result;
    for (const auto& [name, bytes] : memory.outputs()) {
        const std::string format = name.substr(name.rfind('.') + 1);
        result.files[name] = format == "png" ? without_texts(bytes) : without_recipe(format, bytes);
    }
    for (const Remark& remark : made.remarks) {
        EXPECT_TRUE(remark.option.empty() || remark.text.starts_with("'" + remark.option + "' has no effect: "));
        if (remark.is_warning) {
            result.warnings.push_back(remark.text);
        } else {
            result.facts += remark.text + "\n";
        }
    }
    return result;
}

TEST(Options, EveryOneHasAValueToTry) {
    for (const OptionInfo* option : prints().options()) {
        const std::string name(option->name);
        EXPECT_EQ(values.contains(name) + exempt.contains(name), 1) << name;
    }
}

/// `changed`, `told`, `refused`, or `ignored`.
std::string outcome(const Drawing& drawing, const Output& output, const Result& plain, const OptionValues& options) {
    try {
        const Result with = make(drawing, output, options);
        if (with.files != plain.files) return "changed";
        // Speeds change the estimate of time.
        if (with.facts != plain.facts) return "told";
        // The size of the page is always given.
        const std::string quoted = "'" + options.front().name + "' has no effect";
        const bool is_told = std::any_of(with.warnings.begin(), with.warnings.end(), [&](const std::string& text) {
            return text.starts_with(quoted) ||
                   std::find(plain.warnings.begin(), plain.warnings.end(), text) == plain.warnings.end();
        });
        return is_told ? "told" : "ignored";
    } catch (const SettingError&) {
        return "refused";
    } catch (const PatternError&) {
        return "refused";
    } catch (const std::runtime_error&) {
        return "refused";
    }
}

TEST(Options, NoneIsIgnoredInSilence) {
    for (const Drawing& drawing : drawings) {
        for (const Output& output : outputs) {
            Result plain;
            try {
                plain = make(drawing, output, {});
            } catch (const std::runtime_error&) {
                continue;  // a model of a drawing in the plane
            }
            for (const auto& [name, value] : values) {
                if (is_exempt(name, drawing.name, output.name)) continue;
                EXPECT_NE(outcome(drawing, output, plain, {{name, value}}), "ignored")
                    << "--" << name << " '" << value << "' on " << drawing.name << " as " << output.name;
            }
        }
    }
}

}  // namespace sikku::options_test
