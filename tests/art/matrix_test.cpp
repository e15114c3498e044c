// tests/art/matrix_test.cpp: every feature of prints is visible in every kind of output, or refused with a reason.
// docs/matrix.md contains the same table.
#include "art/prints.h"
#include "art/product/print_cell.h"
#include "art/sheet/sheet.h"
#include "engine/base/output.h"
#include "tests/checks.h"
#include "tests/files.h"
#include "tests/print_tools.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace sikku::matrix_test {

constexpr const char* cmyk_profile = "/usr/share/color/icc/ghostscript/default_cmyk.icc";

const std::string kolam =
    "title: Kolam\naxiom: F+XF+F+XFfffffffF+F+F+F\nX --> XF-F-F+XF+F+XF-F-F+X\nderivation length: 1\nangle "
    "increment: 90\n"
    "stroke: 0.2 step #f2b632\nground: #8c3b2a\n";
const std::string shape =
    "title: Shape\naxiom: {F+F+F+F}\nF --> FF\nderivation length: 1\nangle increment: 90\n"
    "stroke: 0.4mm #203060\nground: #ffffff\n";
/// Two tiles with an edge in common.
const std::string squares =
    "title: Squares\naxiom: {F+F+F+F}+f{F+F+F+F}\nF --> F\nderivation length: 1\nangle increment: 90\n"
    "stroke: 0.4mm #203060\nground: #ffffff\npalette: #203060 #304060\nfill: #30a050\n";
/// A tiling by squares.
const std::string grid =
    "title: Grid\naxiom: A\nA --> A[fA][+f-A][f+f-A]\nf --> ff\nderivation length: 2\nangle increment: 90\n"
    "heading: 0\nturn: left\nstroke: 0.4mm #203060\nground: #ffffff\npalette: #203060 #304060\n"
    "interpret:\nA --> {F+F+F+F}\n";
/// A tiling by rows of squares, which repeats in both directions.
const std::string rows =
    "title: Rows\naxiom: X\nderivation length: 8\nangle increment: 90\nheading: 0\nturn: left\n"
    "table rows:\nX --> [Y]vX\ntable cells:\nY --> CuY\nschedule: rows*((n+1)/2) cells*(n/2)\n"
    "stroke: 0.4mm #203060\nground: #ffffff\npalette: #203060 #304060\ninterpret:\nu --> f\nv --> +f-\n"
    "C --> [{F+F+F+F}]\n";
/// A line with numbers at its corners.
const std::string numbered =
    "title: Numbered\naxiom: FN(1)+F-FN(27)+F\nF --> F\nderivation length: 1\nangle increment: 90\n"
    "stroke: 0.1 step #f2b632\nground: #8c3b2a\n";
/// A fill whose edges no line draws.
const std::string leaf =
    "title: Leaf\naxiom: {f+f+f+f}F'F\nderivation length: 1\nangle increment: 90\n"
    "stroke: 1mm #203060\nground: #ffffff\npalette: #203060 #304060\n";
/// A line that crosses itself.
const std::string woven =
    "title: Woven\naxiom: FXFFXFFXFFXF\nX --> -F-F-F\nderivation length: 1\nangle increment: 90\n"
    "stroke: 0.2 step #f2b632\nground: #8c3b2a\n";
const std::string solid =
    "title: Solid\naxiom: F\nF --> F[&F]F\nderivation length: 2\nangle increment: 40\nstroke: 0.2 step #203060\n"
    "ground: #ffffff\n";

/// A polygon that begins in one branch and ends in another.
const std::string blade =
    "title: Blade\naxiom: {.[+F'F.]FF.}\nF --> F\nderivation length: 1\nangle increment: 60\npolygons: framework\n"
    "stroke: 1mm #203060\nground: #ffffff\npalette: #203060 #304060\n";
const std::string bent =
    "title: Bent\naxiom: F~leaf(2)\nF --> F\nderivation length: 1\nstroke: 0.2 step #203060\nground: #ffffff\n"
    "patch leaf:\n0 0 0, .3 0 0, .6 0 0, 1 0 0\n-.5 1 .3, 0 1 0, .5 1 0, 1.5 1 .3\n"
    "-.5 2 .3, 0 2 0, .5 2 0, 1.5 2 .3\n0 3 0, .3 3 0, .6 3 0, 1 3 0\n";

using Values = std::map<std::string, std::string>;

/// A feature: the settings of a print, and the settings it is compared with.
struct Feature {
    std::string name;
    std::string pattern;
    Values keys;    ///< keys of the pattern
    Values values;  ///< options
    Values without;
    Values without_keys{};
};

std::vector<Feature> features() {
    return {
        {"dots", kolam, {}, {{"dots", ""}}, {}},
        {"only dots", kolam, {}, {{"dots", "only"}}, {}},
        {"distance of dots", kolam, {}, {{"dot-spacing", "7mm"}}, {}},
        {"border", kolam, {}, {{"border", "kaavi"}}, {}},
        {"border of two strands", kolam, {}, {{"border", "rope"}}, {}},
        {"border of a pattern", kolam, {}, {{"border", "snake-kolam"}}, {}},
        {"repeat", kolam, {}, {{"repeat", "frieze:3"}}, {}},
        {"composed margins", kolam, {}, {{"compose", "true"}}, {}},
        {"line of text", kolam, {}, {{"title-line", ""}, {"edition", "3/50"}}, {}},
        {"title in a font", kolam, {}, {{"title-line", ""}, {"font", "Noto Serif"}}, {{"title-line", ""}}},
        {"place of the title",
         kolam,
         {},
         {{"title-line", ""}, {"title-size", "2mm"}, {"title-place", "above,centre"}},
         {{"title-line", ""}}},
        {"weight of the title", kolam, {}, {{"title-line", ""}, {"title-weight", "bold"}}, {{"title-line", ""}}},
        {"colours by strand", kolam, {}, {{"colour-by", "strand"}}, {}},
        {"fields", kolam, {{"fields", "chessboard"}}, {}, {}},
        {"hatched fields",
         kolam,
         {{"fields", "chessboard"}},
         {{"plotter", "true"}, {"hatch", "2mm"}},
         {{"plotter", "true"}}},
        {"white paper",
         kolam,
         {{"paper", "white"}, {"stroke", "0.2 step #fffaf0"}},
         {},
         {},
         {{"stroke", "0.2 step #fffaf0"}}},
        {"colouring page", kolam, {}, {{"colouring", "0"}}, {}},
        {"powders",
         kolam,
         {{"fields", "by kind"}, {"powders", "lotus"}},
         {},
         {},
         {{"fields", "by kind"}, {"powders", "peacock"}}},
        {"weave", woven, {{"weave", "yes"}}, {}, {}},
        {"parallel lines", kolam, {{"parallel", "3"}}, {}, {}},
        {"fills", leaf, {{"fill", "#30a050"}}, {}, {}, {{"fill", "#00000000"}}},
        {"blades", blade, {{"fill", "#30a050"}}, {}, {}, {{"fill", "#00000000"}}},
        {"surfaces", bent, {{"fill", "#30a050"}}, {}, {}, {{"fill", "#00000000"}}},
        {"labels", numbered, {{"label N", "{1}"}}, {}, {}},
        {"labels on splines", numbered, {{"label N", "{1}"}, {"line", "spline"}}, {}, {}, {{"line", "spline"}}},
        {"labels by hand", numbered, {{"label N", "{1}"}, {"hand", "0.5"}}, {}, {}, {{"hand", "0.5"}}},
        {"labels of parallel lines", numbered, {{"label N", "{1}"}, {"parallel", "2"}}, {}, {}, {{"parallel", "2"}}},
        {"labels in space", solid + "interpret:\nF --> FN(3)\n", {{"label N", "{1}"}}, {}, {}},
        {"colours of tiles", leaf, {{"tile colours", "by shape"}}, {}, {}},
        {"filled page", grid, {}, {{"fill-page", "true"}}, {}},
        {"swatch", rows, {}, {{"swatch", ""}, {"step", "5mm"}}, {{"step", "5mm"}}},
        {"tiles that divide", grid, {}, {{"divide", ""}}, {}},
        {"names of tiles", squares, {}, {{"name-tiles", "true"}}, {}},
        {"edges of tiles", squares, {{"tile edges", "border"}}, {}, {}},
        {"kerf", squares, {{"tile edges", "border"}}, {{"kerf", "1mm"}}, {}, {{"tile edges", "border"}}},
        {"decorated tiles", squares, {{"decorate", "kolam"}}, {}, {}},
        {"splines", kolam, {{"line", "spline"}}, {}, {}, {{"line", "straight"}}},
        {"lines by hand", kolam, {{"hand", "0.5"}}, {}, {}, {{"hand", "0"}}},
        {"window", kolam, {}, {{"window", "-1,-1,2,2"}}, {}},
        {"view", solid, {}, {{"view", "30,60"}}, {}},
        {"light", solid, {}, {{"light", "sun"}}, {}},
        {"rotation", kolam, {}, {{"rotate", "30"}}, {}},
        {"step", kolam, {}, {{"step", "3mm"}}, {}},
        {"animation", kolam, {}, {{"animate", "5"}}, {}},
        {"lesson", kolam, {}, {{"lesson", ""}}, {}},
        {"plotter", shape, {}, {{"plotter", "true"}}, {}},
        {"hatching",
         leaf,
         {{"fill", "#30a050"}},
         {{"plotter", "true"}, {"hatch", "2mm,30"}},
         {{"plotter", "true"}},
         {{"fill", "#30a050"}}},
        {"pen width", leaf, {}, {{"plotter", "true"}, {"pen-width", "0.3mm"}}, {{"plotter", "true"}}},
        {"merged pens", leaf, {}, {{"plotter", "true"}, {"pens", "1"}}, {{"plotter", "true"}}},
        {"HP-GL paper", kolam, {}, {{"hpgl-paper", "A4"}}, {}},
        {"plotter profile", leaf, {}, {{"plotter", "true"}, {"profile", "axidraw"}}, {{"plotter", "true"}}},
        {"settings of a pen", kolam, {}, {{"pen", "1 speed=20"}}, {}},
        {"parking place", leaf, {{"fill", "#30a050"}}, {{"park", "5,5"}}, {}, {{"fill", "#30a050"}}},
        {"refilling", kolam, {}, {{"plotter", "true"}, {"refill", "100mm@5,5"}}, {{"plotter", "true"}}},
        {"resumed plot", kolam, {}, {{"plotter", "true"}, {"resume", "100mm"}}, {{"plotter", "true"}}},
        {"no arcs", kolam, {{"line", "spline"}}, {{"arcs", "false"}}, {}, {{"line", "spline"}}},
        {"minimum arc", kolam, {{"line", "spline"}}, {{"min-arc", "20mm"}}, {}, {{"line", "spline"}}},
        {"pen-up travel", kolam, {}, {{"plotter", "true"}, {"travel", "true"}}, {{"plotter", "true"}}},
        {"bleed", kolam, {}, {{"bleed", "3mm"}}, {}},
        {"crop marks", kolam, {}, {{"marks", "true"}}, {}},
        {"registration marks", kolam, {}, {{"registration", "true"}}, {}},
        {"overprint", kolam, {}, {{"spot", "A=#8c3b2a"}, {"overprint", "all"}}, {{"spot", "A=#8c3b2a"}}},
        {"spot colours", kolam, {}, {{"spot", "Kaavi=#8c3b2a"}}, {}},
        {"CMYK", kolam, {}, {{"cmyk", cmyk_profile}}, {}},
        {"one bit", kolam, {}, {{"bits", "1"}}, {}},
        {"screening", kolam, {}, {{"bits", "1"}, {"screen", "diffusion"}}, {{"bits", "1"}}},
        {"relief", shape, {}, {{"relief", "3mm"}}, {}},
        {"heights of lines",
         kolam,
         {{"dots", "3mm white"}},
         {{"relief", ""}, {"ridge", "1mm"}},
         {{"relief", ""}},
         {{"dots", "3mm white"}}},
        {"base of a relief", shape, {}, {{"relief", ""}, {"base", "3mm,2mm"}}, {{"relief", ""}}},
        {"grooves", squares, {}, {{"relief", ""}, {"groove", "2mm"}}, {{"relief", ""}}},
        {"tiles", kolam, {}, {{"tile", "60x60mm"}}, {}},
        {"highlighted step", kolam, {}, {{"highlight", "1"}}, {}},
        {"productions", kolam, {}, {{"rule", "true"}}, {}},
        {"sheet of generations", kolam, {}, {{"generations", "0:2"}}, {}},
        {"frames", kolam, {}, {{"generations", "0:2"}, {"frames", "true"}}, {}}};
}

/// A kind of output.
struct Target {
    std::string name;
    std::string format;
    Values values;
    bool is_cell = false;
};

std::vector<Target> targets() {
    const Values one{};
    const Values growth{{"generations", "0:2"}};
    return {{"SVG", "svg", one},
            {"PDF", "pdf", one},
            {"EPS", "eps", one},
            {"PNG", "png", one},
            {"TIFF", "tif", one},
            {"JPEG", "jpg", one},
            {"EXR", "exr", one},
            {"GIF", "gif", growth},
            {"HP-GL", "hpgl", one},
            {"G-code", "gcode", one},
            {"DXF", "dxf", one},
            {"OBJ", "obj", one},
            {"glTF", "glb", one},
            {"STL", "stl", {{"relief", "1mm,2mm"}}},
            {"poster", "svg", one, true},
            {"sheet", "svg", growth},
            {"tile", "svg", {{"tile", "60x60mm"}}},
            {"frame", "svg", {{"generations", "0:2"}, {"frames", "true"}}}};
}

/// Combinations where a feature rightly changes nothing: HP-GL and STL have no colours, and those of glTF are not
/// compared; an STL is always a relief, and has
/// grooves instead of the edges of tiles, HP-GL, G-code
/// and DXF are always plots, which fill fields only by hatching, a light only by pictures, and a sheet of generations
/// is compared with itself.
const std::set<std::string> unchanged = {"light on SVG",
                                         "light on PDF",
                                         "light on EPS",
                                         "light on HP-GL",
                                         "light on G-code",
                                         "light on DXF",
                                         "light on sheet",
                                         "light on tile",
                                         "light on frame",
                                         "fields on HP-GL",
                                         "fields on G-code",
                                         "fields on DXF",
                                         "powders on HP-GL",
                                         "powders on G-code",
                                         "powders on DXF",
                                         "plotter on HP-GL",
                                         "plotter on G-code",
                                         "plotter on DXF",
                                         "sheet of generations on GIF",
                                         "sheet of generations on frame",
                                         "sheet of generations on sheet",
                                         "frames on frame",
                                         "relief on STL",
                                         "powders on STL",
                                         "colours of tiles on STL",
                                         "edges of tiles on STL",
                                         "white paper on HP-GL",
                                         "white paper on glTF",
                                         "white paper on STL",
                                         "tiles on tile"};

using Outputs = std::map<std::string, std::string>;

/// The drawing in an output, without texts about how it was made.
std::string drawing_of(const std::string& name, std::string bytes, const ScratchFolder& folder) {
    const std::string format = name.substr(name.rfind('.') + 1);
    if (format == "glb") {
        const auto length = static_cast<unsigned char>(bytes[12]) + 256U * static_cast<unsigned char>(bytes[13]);
        return bytes.substr(20 + length);
    }
    if (format == "png" || format == "tif" || format == "jpg" || format == "exr") {
        // OpenImageIO remembers what it knows of a name.
        static int number = 0;
        const std::string file = (folder.path() / (std::to_string(++number) + "." + format)).string();
        std::ofstream(file, std::ios::binary) << bytes;
        // Compares size, channels, bits and pixels, but not the texts.
        OIIO::ImageBuf picture(file);
        EXPECT_TRUE(picture.read(0, 0, true)) << picture.geterror();
        const OIIO::ImageSpec& spec = picture.spec();
        return std::to_string(spec.width) + ' ' + std::to_string(spec.height) + ' ' + std::to_string(spec.nchannels) +
               ' ' + std::string(spec.format.c_str()) + ' ' +
               std::string(spec.get_string_attribute("oiio:ColorSpace")) + ' ' +
               std::to_string(spec.get_int_attribute("oiio:BitsPerSample")) + ' ' +
               OIIO::ImageBufAlgo::computePixelHashSHA1(picture);
    }
    return without_recipe(format, std::move(bytes));
}

class Matrix : public ::testing::Test {
protected:
    Document document(const Feature& feature, const Values& keys) const {
        Document result = parse("matrix.lsys", feature.pattern);
        std::vector<Setting> settings;
        for (const auto& [key, value] : keys) settings.emplace_back(key, value);
        return settings.empty() ? result : result.with(settings);
    }

    static OptionValues merged(const Values& one, const Values& two) {
        Values all = two;
        all.insert(one.begin(), one.end());
        all.insert({"size", "100x100mm"});
        all.insert({"dpi", "60"});
        OptionValues values;
        for (const auto& [name, text] : all) values.push_back({name, text});
        return values;
    }

    /// @throws SettingError, PatternError
    Outputs make(const Feature& feature, const Target& target, bool with) const {
        const Document drawn = document(feature, with ? feature.keys : feature.without_keys);
        const OptionValues values = merged(with ? feature.values : feature.without, target.values);
        MemoryDestination memory;
        if (target.is_cell) {
            make_cell(drawn, values, memory);
        } else {
            prints().plan(drawn, target.format, values)->make(memory, "print." + target.format, {});
        }
        Outputs outputs;
        for (const auto& [name, bytes] : memory.outputs()) {
            EXPECT_FALSE(bytes.empty()) << name;
            outputs[name] = drawing_of(name, bytes, folder_);
        }
        EXPECT_FALSE(outputs.empty());
        return outputs;
    }

    static void make_cell(const Document& drawn, const OptionValues& values, Destination& destination) {
        for (const OptionValue& value : values) {
            if (find_option(prints().options(), value.name)->is_alone) {
                throw SettingError(value.name, value.text, "galleries have one file for each derivation length");
            }
        }
        SheetOptions sheet;
        sheet.page = {100.0, 100.0, 5.0};
        draw_sheet({print_cell(drawn, read_draw_settings(values))}, sheet, "poster.svg", destination);
    }

    /// The entry of the table: `yes`, `no change`, or a reason.
    std::string outcome(const Feature& feature, const Target& target) const {
        try {
            const Outputs with = make(feature, target, true);
            const bool is_visible = with != make(feature, target, false);
            if (is_visible) return "yes";
            return target.is_cell || unchanged.contains(feature.name + " on " + target.name) ? "no change" : "lost";
        } catch (const SettingError& error) {
            return error.message();
        } catch (const PatternError& error) {
            return error.diagnostics().front().message;
        }
    }

    ScratchFolder folder_;
};

std::string table(const std::vector<std::vector<std::string>>& outcomes) {
    std::string text =
        "# Features and outputs\n\n"
        "This table shows which feature of prints works with which output. `yes`: the feature is drawn. `=`: it\n"
        "has no effect on the drawing. A number: it is refused, for the reason below the table.\n"
        "`poster` is a cell of a poster or contact sheet, `sheet` a sheet of generations, `tile` one sheet of a\n"
        "tiled print, and `frame` one of several generations in separate files.\n\n|  |";
    for (const Target& target : targets()) text += " " + target.name + " |";
    text += "\n|---|";
    for (std::size_t i = 0; i < targets().size(); ++i) text += "---|";
    text += "\n";
    std::vector<std::string> reasons;
    for (std::size_t row = 0; row < outcomes.size(); ++row) {
        text += "| " + features()[row].name + " |";
        for (const std::string& outcome : outcomes[row]) {
            std::string entry = outcome == "yes" ? "yes" : outcome == "no change" ? "=" : "";
            if (entry.empty()) {
                auto place = std::find(reasons.begin(), reasons.end(), outcome);
                if (place == reasons.end()) place = reasons.insert(place, outcome);
                entry = std::to_string(place - reasons.begin() + 1);
            }
            text += " " + entry + " |";
        }
        text += "\n";
    }
    text += "\n";
    for (std::size_t i = 0; i < reasons.size(); ++i) text += std::to_string(i + 1) + ". " + reasons[i] + "\n";
    return text;
}

TEST_F(Matrix, EveryFeatureIsDrawnOrRefusedForAReason) {
    if (!std::filesystem::exists(cmyk_profile)) GTEST_SKIP() << cmyk_profile << " is not installed";
    std::vector<std::vector<std::string>> outcomes;
    for (const Feature& feature : features()) {
        outcomes.emplace_back();
        for (const Target& target : targets()) {
            SCOPED_TRACE(feature.name + " on " + target.name);
            std::string result;
            ASSERT_NO_THROW(result = outcome(feature, target));
            outcomes.back().push_back(result);
            EXPECT_NE(result, "lost");
            EXPECT_FALSE(has(result, "--"));
            EXPECT_FALSE(has(result, "\n"));
            EXPECT_GT(result.size(), 2u);
        }
    }
    const std::filesystem::path file = std::filesystem::path(SIKKU_SOURCE_DIR) / "docs/matrix.md";
    const std::string text = table(outcomes);
    if (std::getenv("SIKKU_WRITE_DOCS")) std::ofstream(file) << text;
    EXPECT_EQ(contents(file), text) << "SIKKU_WRITE_DOCS=1 writes it";
}

}  // namespace sikku::matrix_test
