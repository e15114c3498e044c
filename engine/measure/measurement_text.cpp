// engine/measure/measurement_text.cpp: formats a measurement as text and as JSON.
#include "engine/base/diagnostic.h"
#include "engine/base/json_text.h"
#include "engine/measure/extent.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace sikku {
namespace {

std::string plain_number(double value) {
    if (!std::isfinite(value)) return "null";
    if (value == 0) return "0";  // never -0
    if (value == std::floor(value) && std::fabs(value) < 0x1p53) return fmt::format("{:.0f}", value);
    return fmt::format("{}", value);
}

JsonText quantity_json(const Quantity& quantity) {
    return quantity.digits.empty() ? JsonText::raw(plain_number(quantity.value)) : quantity.digits;
}

/// Geometry of a drawing in the plane or in space, with two or three axes.
struct Geometry {
    std::vector<Quantity> box, ink, end;
    std::optional<double> heading;  ///< in the plane only
    bool closed = false;
    std::int64_t depth = 0;
};

std::vector<Quantity> numbers(const SpaceBounds& bounds) {
    std::vector<Quantity> result;
    for (const glm::dvec3& corner : {bounds.low, bounds.high}) {
        for (int axis = 0; axis < 3; ++axis) result.push_back(Quantity::of(corner[axis]));
    }
    return result;
}

std::optional<Geometry> geometry_of(const Measurement& m) {
    if (m.space) {
        const SpaceSurvey& s = *m.space;
        return Geometry{numbers(s.box),
                        s.ink ? numbers(*s.ink) : std::vector<Quantity>(),
                        {Quantity::of(s.end.x), Quantity::of(s.end.y), Quantity::of(s.end.z)},
                        std::nullopt,
                        s.closed,
                        s.depth};
    }
    if (!m.geometry) return std::nullopt;
    const Fold& f = *m.geometry;
    Geometry result{{f.box.begin(), f.box.end()}, {}, {f.end.begin(), f.end.end()}, f.heading, f.closed, f.depth};
    if (f.ink) result.ink.assign(f.ink->begin(), f.ink->end());
    return result;
}

std::string plain(const Quantity& quantity) {
    if (!quantity.digits.empty()) return quantity.digits;
    if (quantity.value == std::floor(quantity.value)) return plain_number(quantity.value);
    return fmt::format("{:.6g}", quantity.value);
}

std::string plain(const std::vector<Quantity>& list) {
    std::string text;
    for (const Quantity& quantity : list) text += (text.empty() ? "" : " ") + plain(quantity);
    return text;
}

}  // namespace

std::string measurement_json(const std::string& title, const Measurement& m) {
    std::vector<std::pair<std::string, JsonText>> counts;
    for (const auto& [letter, count] : m.counts) counts.emplace_back(letter, quantity_json(count));
    JsonText length = quantity_json(m.length);
    if (m.length.digits.empty() && length.text.find_first_not_of("0123456789") == std::string::npos) {
        length.text += ".0";
    }
    const std::optional<Geometry> g = geometry_of(m);
    const auto list = [](const std::vector<Quantity>& values) { return JsonText::list(values, quantity_json); };
    return JsonText::object(
               "title", title, "n", JsonText::whole(m.n), "symbols", quantity_json(m.symbols), "counts",
               JsonText::object_of(counts), "drawn", quantity_json(m.drawn), "moves", quantity_json(m.moves),
               "length", length, "polygons", quantity_json(m.polygons), "box", g ? list(g->box) : nullptr, "ink",
               g && !g->ink.empty() ? list(g->ink) : nullptr, "end", g ? list(g->end) : nullptr, "heading",
               g && g->heading ? JsonText::raw(plain_number(*g->heading)) : nullptr, "closed",
               g ? JsonText(g->closed) : nullptr, "depth", g ? JsonText(g->depth) : nullptr, "derived", m.derived)
        .line();
}

std::string measurement_text(const std::string& title, const Measurement& m) {
    std::string text = fmt::format("{}, n = {}\n", title.empty() ? "(untitled)" : printable(title), m.n);
    const auto line = [&](std::string_view name, const std::string& value) {
        text += fmt::format("{:<9}{}\n", name, value);
    };
    line("symbols", plain(m.symbols));
    std::string counts;
    for (const auto& [letter, count] : m.counts) {
        counts += fmt::format("{}{} {}", counts.empty() ? "" : "   ", printable(letter), plain(count));
    }
    if (!counts.empty()) line("counts", counts);
    line("drawn", plain(m.drawn));
    line("moves", plain(m.moves));
    line("length", plain(m.length));
    if (m.polygons.value > 0) line("polygons", plain(m.polygons));
    if (const std::optional<Geometry> g = geometry_of(m)) {
        line("box", plain(g->box));
        line("ink", g->ink.empty() ? "none" : plain(g->ink));
        line("end", plain(g->end));
        if (g->heading) line("heading", fmt::format("{:.6g} degrees", *g->heading));
        line("closed", g->closed ? "yes" : "no");
        line("depth", fmt::format("{}", g->depth));
    } else {
        text += "The word is too long for its box to be worked out.\n";
    }
    line("derived", m.derived ? "yes" : "no");
    return text;
}

}  // namespace sikku
