#include "engine/tiling/cut_list.h"

#include "engine/base/diagnostic.h"
#include "engine/base/json_text.h"
#include "engine/base/text.h"
#include "engine/geometry/polygon_classes.h"
#include "engine/tiling/tiling_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

namespace sikku {
namespace {

/// A to Z, then AA, AB, …
std::string kind_name(std::size_t index) {
    std::string name;
    for (std::size_t rest = index + 1; rest > 0; rest = (rest - 1) / 26) {
        name.insert(name.begin(), static_cast<char>('A' + (rest - 1) % 26));
    }
    return name;
}

std::string hundredths(double value) {
    return fmt::format("{}", std::round(value * 100) / 100);
}

std::string listed(const std::vector<double>& values, double factor) {
    std::string text;
    for (const double value : values) text += (text.empty() ? "" : " ") + hundredths(value * factor);
    return text;
}

const char* hand_name(const TilingExamination& examination, const CutKind& kind) {
    if (!examination.shapes[kind.shape].is_chiral) return "-";
    return kind.is_reflected ? "mirrored" : "as drawn";
}

/// A number for each class of tiles: the same for those that differ by a half turn.
std::vector<std::uint32_t> half_turn_classes(const TilingResult& result) {
    const TileSet& tiles = result.patch.tiles;
    PolygonClasses classes(result.patch.plane.is_rough() ? 4 * result.patch.plane.tolerance() : 0);
    std::vector<std::uint32_t> numbers;
    for (const TileClass& in_class : tiles.classes) {
        std::vector<glm::dvec2> corners, turned;
        for (const std::uint32_t corner : tiles.corners(in_class.first)) {
            corners.push_back(result.patch.plane.at(corner));
            turned.push_back(-corners.back());
        }
        numbers.push_back(std::min(classes.classify(corners).direction, classes.classify(turned).direction));
    }
    return numbers;
}

}  // namespace

std::vector<CutKind> cut_list(const TilingResult& result, double step, bool keeps_direction) {
    const TileSet& tiles = result.patch.tiles;
    std::vector<CutKind> kinds;
    std::map<std::tuple<std::uint32_t, bool, std::int32_t, std::uint32_t>, std::size_t> known;
    const std::vector<std::uint32_t> directions =
        keeps_direction ? half_turn_classes(result) : std::vector<std::uint32_t>(tiles.classes.size(), 0);
    for (std::uint32_t tile = 0; tile < tiles.tiles(); ++tile) {
        const TileClass& in_class = tiles.class_of(tile);
        const auto [at, is_new] = known.try_emplace(
            {in_class.shape, in_class.is_reflected, tiles.colour[tile], directions[tiles.in_class[tile]]},
            kinds.size());
        if (is_new) {
            CutKind& kind = kinds.emplace_back();
            kind.name = kind_name(at->second);
            kind.shape = in_class.shape;
            kind.is_reflected = in_class.is_reflected;
            kind.colour = tiles.colour[tile];
            kind.area = std::fabs(in_class.area) * step * step;
            for (const std::uint32_t corner : tiles.corners(tile)) {
                kind.corners.push_back(result.patch.plane.at(corner) * step);
            }
        }
        ++kinds[at->second].pieces;
    }
    return kinds;
}

std::string missing_pieces(const TilingExamination& examination) {
    if (examination.violations.count == 0) return {};
    return fmt::format("{} left out or overlap: see the examination without this option",
                       counted(examination.violations.count, "polygon"));
}

std::string cut_list_text(const std::string& title, std::optional<std::int64_t> n, const TilingResult& result,
                          double step) {
    const TilingExamination& t = result.examination;
    std::string text = fmt::format("{}{}, a {} of {} mm\n", title.empty() ? "(untitled)" : printable(title),
                                   n ? fmt::format(", n = {}", *n) : "", n ? "step" : "unit", hundredths(step));
    text += "kind    pieces  hand      colour     area mm2  all cm2     sides in mm; angles\n";
    double area = 0;
    for (const CutKind& kind : cut_list(result, step)) {
        const double all = kind.area * static_cast<double>(kind.pieces);
        area += all;
        const TileShape& shape = t.shapes[kind.shape];
        text += fmt::format("{:<4} {:>9}  {:<8}  {:>6} {:>12}  {:<10}  {}; {}\n", kind.name, kind.pieces,
                            hand_name(t, kind), kind.colour, hundredths(kind.area), hundredths(all / 100),
                            listed(shape.sides, step), listed(shape.angles, 1));
    }
    text += fmt::format("{}, {} cm2\n", counted(t.tiles, "piece"), hundredths(area / 100));
    if (const std::string missing = missing_pieces(t); !missing.empty()) text += missing + "\n";
    return text;
}

std::string cut_list_json(const std::string& title, std::optional<std::int64_t> n, const TilingResult& result,
                          double step) {
    const TilingExamination& t = result.examination;
    const auto corner = [](glm::dvec2 at) { return std::array{at.x, at.y}; };
    const auto kind = [&](const CutKind& each) {
        const TileShape& shape = t.shapes[each.shape];
        return JsonText::object("kind", each.name, "shape", each.shape, "name", shape_name(shape), "hand",
                                shape.is_chiral ? JsonText(hand_name(t, each)) : nullptr, "colour", each.colour,
                                "pieces", each.pieces, "area", each.area, "corners",
                                JsonText::list(each.corners, corner));
    };
    return JsonText::object("title", title, "n", n, "step", step, "pieces", t.tiles, "violations", t.violations.count,
                            "area", t.area * step * step, "kinds", JsonText::list(cut_list(result, step), kind))
        .line();
}

}  // namespace sikku
