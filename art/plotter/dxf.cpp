#include "art/plotter/dxf.h"

#include "art/plotter/arc_writer.h"
#include "art/print/micrometres.h"
#include "art/print/recipe_comments.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sikku {
namespace {

/// Arcs of one circle have centres and radii that differ by less, in millimetres.
constexpr double circle_tolerance = 0.002;

/// The number of the nearest standard colour, from 1. Number 7 is black on white, and white on black.
int standard_colour(Colour colour) {
    constexpr std::array<std::array<int, 3>, 7> standard = {
        {{255, 0, 0}, {255, 255, 0}, {0, 255, 0}, {0, 255, 255}, {0, 0, 255}, {255, 0, 255}, {0, 0, 0}}};
    int nearest = 0, least = std::numeric_limits<int>::max();
    for (int i = 0; i < static_cast<int>(standard.size()); ++i) {
        const auto& [red, green, blue] = standard[static_cast<std::size_t>(i)];
        const int distance = (colour.red - red) * (colour.red - red) +
                             (colour.green - green) * (colour.green - green) +
                             (colour.blue - blue) * (colour.blue - blue);
        if (distance < least) {
            least = distance;
            nearest = i + 1;
        }
    }
    return nearest;
}

glm::dvec2 rounded(glm::dvec2 millimetres) {
    return {std::round(millimetres.x * 1e4) / 1e4, std::round(millimetres.y * 1e4) / 1e4};
}

std::string place(glm::dvec2 at, int first_code = 10) {
    return fmt::format("{}\n{}\n{}\n{}\n", first_code, decimal(at.x, 4), first_code + 10, decimal(at.y, 4));
}

/// A vertex of a polyline and the bulge of the segment that follows it: the tangent of a quarter of an arc's
/// angle, above 0 for anticlockwise, 0 for a line.
struct Vertex {
    glm::dvec2 at{0.0};
    double bulge = 0;
};

/// The tangent of a quarter of the angle of an arc between two points.
double bulge_of(const PlotArc& arc, glm::dvec2 from, glm::dvec2 to) {
    const glm::dvec2 a = from - arc.centre, b = to - arc.centre;
    double sweep = std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y);
    if (arc.is_left && sweep < 0) sweep += 2 * std::numbers::pi;
    if (!arc.is_left && sweep > 0) sweep -= 2 * std::numbers::pi;
    return std::tan(sweep / 4);
}

struct Circle {
    glm::dvec2 centre{0.0};
    double radius = 0;
};

/// The circle on which all arcs of a closed polyline lie, if there is one.
std::optional<Circle> circle_of(const std::vector<Vertex>& vertices) {
    std::optional<Circle> circle;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const glm::dvec2 from = vertices[i].at, to = vertices[(i + 1) % vertices.size()].at;
        const double bulge = vertices[i].bulge;
        if (bulge == 0) return std::nullopt;
        const glm::dvec2 chord = to - from;
        const glm::dvec2 left(-chord.y, chord.x);
        const glm::dvec2 centre = (from + to) / 2.0 + (1 - bulge * bulge) / (4 * bulge) * left;
        const double radius = glm::distance(centre, from);
        if (!circle) circle = Circle{centre, radius};
        if (glm::distance(circle->centre, centre) > circle_tolerance ||
            std::fabs(circle->radius - radius) > circle_tolerance || (bulge > 0) != (vertices.front().bulge > 0)) {
            return std::nullopt;
        }
    }
    return circle;
}

class DxfWriter final : public ArcWriter {
public:
    DxfWriter(const Print& print, Output& file, std::vector<TileKind> kinds)
        : ArcWriter(print, file, true, 0.0), kinds_(std::move(kinds)) {
        file_.write("999\nSikku, millimetres\n");
        for (const std::string& piece : recipe_comments(print.pattern, print.made))
            file_.write("999\n" + piece + "\n");
        file_.write(fmt::format(
            "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1009\n9\n$INSUNITS\n70\n4\n9\n$MEASUREMENT\n70\n1\n9\n"
            "$EXTMIN\n{}9\n$EXTMAX\n{}0\nENDSEC\n",
            place({0, 0}), place({print.page.width, print.page.height})));
    }

    void begin_stroke(glm::dvec2 start, const Pen& pen) override {
        begin_entities();
        PlotWriter::begin_stroke(start, pen);
    }
    void end_stroke(bool closed) override {
        if (vertices_.empty()) return;
        finish_curve();
        const bool is_there_and_back = vertices_.size() < 4 && vertices_.front().bulge == 0;
        closed = closed && !is_there_and_back && vertices_.front().at == vertices_.back().at;
        if (closed) vertices_.pop_back();
        const std::string name = layer_of(pen_);
        if (vertices_.size() == 1) {
            file_.write(fmt::format("0\nPOINT\n8\n{}\n{}", name, place(vertices_.front().at)));
        } else if (const auto circle = closed ? circle_of(vertices_) : std::nullopt) {
            file_.write(
                fmt::format("0\nCIRCLE\n8\n{}\n{}40\n{}\n", name, place(circle->centre), decimal(circle->radius, 4)));
        } else if (vertices_.size() == 2 && !closed && vertices_.front().bulge == 0) {
            file_.write(fmt::format("0\nLINE\n8\n{}\n{}{}", name, place(vertices_.front().at),
                                    place(vertices_.back().at, 11)));
        } else {
            write_polyline(name, closed);
        }
        vertices_.clear();
    }
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override {
        const Colour colour = print_.style.fill_colour(pen);
        if (vertices.size() < 3 || colour.alpha == 0) return;
        begin_entities();
        put(on_page(vertices.front()));
        for (const glm::dvec2 vertex : vertices.subspan(1)) line_to(on_page(vertex));
        if (vertices_.size() > 1 && vertices_.front().at == vertices_.back().at) vertices_.pop_back();
        const TileKind& kind = kinds_.at(numbers_of_kinds_.kind_of(vertices, colour));
        // Tiny tiles may vanish by rounding.
        if (vertices_.size() > 2) write_polyline(kind.layer(), true);
        vertices_.clear();
    }
    /// Machines without pens have nothing to dip.
    void dip(glm::dvec2, const Pen&) override {}
    void finish() override {
        begin_entities();
        file_.write("0\nENDSEC\n0\nEOF\n");
    }

private:
    /// The table of layers contains all kinds of tiles and the pens that have been numbered by now.
    void begin_entities() {
        if (begun_) return;
        begun_ = true;
        const std::map<int, int>& pens = numbers();
        file_.write(
            "0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLTYPE\n70\n1\n0\nLTYPE\n2\nCONTINUOUS\n70\n0\n3\nSolid "
            "line\n72\n65\n"
            "73\n0\n40\n0\n0\nENDTAB\n");
        file_.write(fmt::format("0\nTABLE\n2\nLAYER\n70\n{}\n", pens.size() + kinds_.size() + 1) + layer("0", 7));
        for (int pen = 1; pen <= static_cast<int>(pens.size()); ++pen) {
            const auto found =
                std::find_if(pens.begin(), pens.end(), [&](const auto& entry) { return entry.second == pen; });
            const Colour colour = print_.style.line_colour(Pen{.colour = found->first});
            file_.write(layer(layer_of(pen), standard_colour(colour)));
        }
        for (const TileKind& kind : kinds_) file_.write(layer(kind.layer(), standard_colour(kind.colour)));
        file_.write("0\nENDTAB\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n");
    }
    std::string layer_of(int pen) const {
        for (const auto& [index, number] : numbers()) {
            const auto name = print_.style.cut_layers.find(index);
            if (number == pen && name != print_.style.cut_layers.end()) return name->second;
        }
        return fmt::format("PEN-{}", pen);
    }
    static std::string layer(std::string_view name, int colour) {
        return fmt::format("0\nLAYER\n2\n{}\n70\n0\n62\n{}\n6\nCONTINUOUS\n", name, colour);
    }

    void put_down(glm::dvec2 at) override {
        put(at);
        begin_curve(at);
    }
    void line_to(glm::dvec2 millimetres) override {
        if (rounded(millimetres) != vertices_.back().at) put(millimetres);
    }
    void arc_to(const PlotArc& arc, glm::dvec2 end) override {
        const glm::dvec2 next = rounded(end);
        if (next == vertices_.back().at) return;
        vertices_.back().bulge = bulge_of(arc, vertices_.back().at, next);
        put(end);
    }
    void put(glm::dvec2 millimetres) {
        require_on_page(millimetres);
        vertices_.push_back({rounded(millimetres)});
    }

    void write_polyline(const std::string& name, bool closed) {
        file_.write(fmt::format("0\nPOLYLINE\n8\n{}\n66\n1\n{}70\n{}\n", name, place({0, 0}), closed ? 1 : 0));
        for (const Vertex& vertex : vertices_) {
            file_.write(fmt::format("0\nVERTEX\n8\n{}\n{}", name, place(vertex.at)));
            if (vertex.bulge != 0) file_.write(fmt::format("42\n{}\n", decimal(vertex.bulge, 9)));
        }
        file_.write(fmt::format("0\nSEQEND\n8\n{}\n", name));
    }

    std::vector<TileKind> kinds_;
    TileKinds numbers_of_kinds_;
    bool begun_ = false;
    std::vector<Vertex> vertices_;  // vertices of the stroke, in millimetres of the page
};

}  // namespace

std::unique_ptr<PlotWriter> write_dxf(const Print& print, Output& file, std::vector<TileKind> kinds) {
    return std::make_unique<DxfWriter>(print, file, std::move(kinds));
}

}  // namespace sikku
