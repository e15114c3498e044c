#include "art/relief/relief.h"

#include "art/relief/most_triangles.h"
#include "art/relief/outlines.h"
#include "art/relief/solid.h"
#include "art/space/mesh_files.h"
#include "engine/base/bits.h"
#include "engine/base/chance.h"
#include "engine/derivation/derivation.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <tuple>
#include <unordered_map>
#include <vector>

namespace sikku {
namespace {

using Kind = ReliefShape::Kind;
using ColourHeight = std::pair<Colour, double>;

constexpr double edge_tolerance = 1.5;  // micrometres: rounding moves points by less
constexpr std::uint32_t page_layer = 0, base_layer = 1, first_layer = 2;

Colour opaque(Colour colour) {
    colour.alpha = 255;
    return colour;
}

/// Assigns heights in turn to the colours of some shapes, in the order of the palette.
template <class Chosen>
std::vector<ColourHeight> heights_of(const ReliefShapes& shapes, const std::vector<double>& heights,
                                     const Chosen& is_chosen) {
    std::vector<std::tuple<int, bool, Colour>> used;
    for (const ReliefShape& shape : shapes.shapes()) {
        if (!is_chosen(shape)) continue;
        const std::tuple key(shape.colour, shape.kind == Kind::line, opaque(shapes.colour(shape)));
        const auto is_same = [&](const auto& other) { return std::get<2>(other) == std::get<2>(key); };
        const auto known = std::find_if(used.begin(), used.end(), is_same);
        if (known == used.end()) {
            used.push_back(key);
        } else if (std::pair(std::get<0>(key), std::get<1>(key)) <
                   std::pair(std::get<0>(*known), std::get<1>(*known))) {
            *known = key;
        }
    }
    std::sort(used.begin(), used.end(), [](const auto& a, const auto& b) {
        return std::pair(std::get<0>(a), std::get<1>(a)) < std::pair(std::get<0>(b), std::get<1>(b));
    });
    std::vector<ColourHeight> result;
    for (const auto& [index, is_line, colour] : used) {
        result.emplace_back(colour, heights[result.size() % heights.size()]);
    }
    return result;
}

/// Each edge of an outline gives two triangles of its wall and, by its corner, two of the faces beside it.
void require_affordable(const ReliefShapes& shapes, bool has_lines) {
    double edges = 4;
    for (const ReliefShape& shape : shapes.shapes()) {
        const double points = static_cast<double>(shape.end - shape.begin);
        if (shape.kind == Kind::line && !has_lines) continue;
        const double circle = chords_of(2 * std::numbers::pi, shape.radius, relief_tolerance);
        edges += shape.kind == Kind::disc ? circle : shape.kind == Kind::line ? 2 * points + circle : points;
    }
    constexpr double triangles_of_edge = 4;
    if (edges * triangles_of_edge <= static_cast<double>(most_relief_triangles)) return;
    throw BudgetError(
        fmt::format("the relief needs about {:.2g} million triangles, more than the limit of {} million; choose a "
                    "shorter derivation or a window",
                    edges * triangles_of_edge * 1e-6, most_relief_triangles / 1'000'000));
}

/// Height and colour of a raised shape. Later layers lie over earlier ones.
struct Layer {
    bool is_over = false;  ///< lines and discs lie over polygons and areas
    double height = 0;
    Colour colour;
    std::int32_t region = PlaneRegions::outside;

    bool operator==(const Layer& other) const {
        return is_over == other.is_over && height == other.height && colour == other.colour;
    }
};

class ReliefMaker {
public:
    ReliefMaker(const ReliefShapes& shapes, const Print& print, const ReliefOptions& options, const Monitor& monitor)
        : shapes_(shapes),
          print_(print),
          options_(options),
          monitor_(monitor),
          outlines_(relief_tolerance, monitor),
          has_ridges_(!options.ridges.empty()) {
        const auto is_line = [](const ReliefShape& shape) { return shape.kind == Kind::line; };
        report_.heights = heights_of(shapes, options.heights,
                                     [&](const ReliefShape& shape) { return !has_ridges_ || !is_line(shape); });
        if (has_ridges_) report_.ridges = heights_of(shapes, options.ridges, is_line);
    }

    Solid make() {
        add_layers();
        add_regions();
        add_base();
        for (const ReliefShape& shape : shapes_.shapes()) add(shape);
        const auto region_of = [this](std::span<const Winding> windings) { return region(windings); };
        const auto same = [](std::int32_t region) { return region; };
        PlaneRegions plane = divide_plane(outlines_.edges(), edge_tolerance, region_of, monitor_);
        const std::vector<LayerEdge> edges = outlines_of(plane, same);
        const auto first_of = [](std::span<const Winding> windings) {
            return windings.empty() ? PlaneRegions::outside : static_cast<std::int32_t>(windings.front().layer);
        };
        plane = divide_plane(edges, 0, first_of, monitor_);
        require_relief(plane);
        return Solid(std::move(plane), regions_, monitor_);
    }

    ReliefReport& report() { return report_; }

private:
    const ColourHeight& height_of(const ReliefShape& shape) const {
        const auto& list = has_ridges_ && shape.kind == Kind::line ? report_.ridges : report_.heights;
        const Colour colour = opaque(shapes_.colour(shape));
        return *std::find_if(list.begin(), list.end(),
                             [&](const ColourHeight& each) { return each.first == colour; });
    }

    Layer layer_of(const ReliefShape& shape) const {
        const auto& [colour, height] = height_of(shape);
        return {shape.kind == Kind::line || shape.kind == Kind::disc, height, shown(colour)};
    }

    /// An STL does not contain colours, so regions of equal height are one.
    Colour shown(Colour colour) const { return options_.format == PrintFormat::stl ? Colour{} : colour; }

    void add_layers() {
        for (const ReliefShape& shape : shapes_.shapes()) {
            const Layer layer = layer_of(shape);
            if (std::find(layers_.begin(), layers_.end(), layer) == layers_.end()) layers_.push_back(layer);
        }
        std::stable_sort(layers_.begin(), layers_.end(), [](const Layer& a, const Layer& b) {
            if (a.is_over != b.is_over) return b.is_over;
            return std::fabs(a.height) < std::fabs(b.height);
        });
    }

    static std::int32_t micrometres(double height) { return static_cast<std::int32_t>(std::lround(height * 1000)); }

    std::int32_t region_for(std::int32_t height, Colour colour) {
        const auto known = std::find_if(regions_.begin(), regions_.end(), [&](const ReliefRegion& region) {
            return region.height == height && region.colour == colour;
        });
        const auto number = static_cast<std::int32_t>(known - regions_.begin());
        if (known == regions_.end()) regions_.push_back({height, colour});
        return number;
    }

    void add_regions() {
        const std::int32_t base = micrometres(options_.base);
        const Colour ground = print_.style.ground.value_or(Colour{255, 255, 255, 0});
        if (base > 0) {
            base_region_ = region_for(base, shown(ground.alpha == 0 ? Colour{255, 255, 255, 255} : opaque(ground)));
        }
        for (Layer& layer : layers_) {
            const std::int32_t top = base + micrometres(layer.height);
            if (top < 0 || (top == 0 && base > 0)) {
                throw std::runtime_error(fmt::format("a depth of {:g} mm does not fit into a base of {:g} mm",
                                                     -layer.height, options_.base));
            }
            if (top > 0) layer.region = region_for(top, layer.colour);
        }
    }

    /// The page, and the base if it follows the drawing.
    void add_base() {
        const glm::dvec2 size(print_.page.width, print_.page.height);
        const std::vector<glm::dvec2> page = {{0, 0}, {size.x, 0}, size, {0, size.y}};
        outlines_.add_polygon(page, page_layer);
        if (!options_.beyond) return;
        const double beyond = *options_.beyond;
        for (const ReliefShape& shape : shapes_.shapes()) {
            const auto points = shapes_.points(shape);
            if (shape.kind == Kind::line)
                outlines_.add_stroke(points, shape.is_closed, shape.radius + beyond, base_layer);
            if (shape.kind == Kind::disc) outlines_.add_disc(points.front(), shape.radius + beyond, base_layer);
            if (shape.kind == Kind::line || shape.kind == Kind::disc) continue;
            outlines_.add_polygon(points, base_layer);
            if (!(beyond > 0)) continue;
            std::vector<glm::dvec2> around(points.begin(), points.end());
            around.push_back(points.front());
            outlines_.add_stroke(around, true, beyond, base_layer);
        }
    }

    void add(const ReliefShape& shape) {
        monitor_.check();
        const Layer own = layer_of(shape);
        const auto layer = first_layer + static_cast<std::uint32_t>(std::find(layers_.begin(), layers_.end(), own) -
                                                                    layers_.begin());
        const auto points = shapes_.points(shape);
        switch (shape.kind) {
            case Kind::polygon:
                if (!(options_.groove > 0)) return outlines_.add_polygon(points, layer);
                if (!outlines_.add_inside(points, options_.groove / 2, layer)) ++report_.lost;
                return;
            case Kind::area:
                return outlines_.add_polygon(points, layer);
            case Kind::disc:
                return outlines_.add_disc(points.front(), shape.radius, layer);
            case Kind::line:
                if (report_.narrowest == 0 || 2 * shape.radius < report_.narrowest) {
                    report_.narrowest = 2 * shape.radius;
                }
                return outlines_.add_stroke(points, shape.is_closed, shape.radius, layer);
        }
    }

    std::int32_t region(std::span<const Winding> windings) const {
        if (windings.empty() || windings.front().layer != page_layer) return PlaneRegions::outside;
        const Winding& last = windings.back();
        if (last.layer >= first_layer) return layers_[last.layer - first_layer].region;
        return options_.beyond && last.layer != base_layer ? PlaneRegions::outside : base_region_;
    }

    void require_relief(const PlaneRegions& plane) const {
        const bool is_raised = std::any_of(plane.triangles.begin(), plane.triangles.end(), [&](const auto& triangle) {
            return triangle.region != PlaneRegions::outside && triangle.region != base_region_;
        });
        if (is_raised) return;
        if (report_.lost > 0) {
            throw std::runtime_error(fmt::format(
                "nothing is raised: a groove of {:g} mm leaves nothing of the polygons; choose a narrower one or a "
                "larger size",
                options_.groove));
        }
        throw std::runtime_error("nothing is raised: every shape is as high as the base, or outside the page");
    }

    const ReliefShapes& shapes_;
    const Print& print_;
    const ReliefOptions& options_;
    const Monitor& monitor_;
    Outlines outlines_;
    bool has_ridges_;
    std::vector<Layer> layers_;
    std::vector<ReliefRegion> regions_;
    std::int32_t base_region_ = PlaneRegions::outside;
    ReliefReport report_;
};

glm::vec3 millimetres(const SolidPoint& point) {
    return glm::vec3(glm::dvec3(point.x, point.y, point.z) / 1000.0);
}

struct PointHash {
    std::size_t operator()(const SolidPoint& point) const {
        const auto bits = [](std::int32_t value) { return std::uint64_t{static_cast<std::uint32_t>(value)}; };
        return static_cast<std::size_t>(scrambled(scrambled(bits(point.x) << 32 | bits(point.y)) ^ bits(point.z)));
    }
};

/// The beginning of the 80 bytes before the triangles of an STL.
constexpr std::string_view stl_title = "Binary STL in millimetres, sikku ";

/// Binary STL: 3D Systems 1989; Burns 1993, "Automated Fabrication", section 6.5.
class StlFile {
public:
    StlFile(Output& output, std::size_t triangles) : output_(output) {
        constexpr std::size_t head = 80;
        std::string title = std::string(stl_title) + SIKKU_VERSION;
        title.resize(head, ' ');
        output_.write(title);
        put(static_cast<std::uint32_t>(triangles));
    }
    void add(const SolidTriangle& triangle) {
        const std::array<glm::vec3, 3> corners = {millimetres(triangle[0]), millimetres(triangle[1]),
                                                  millimetres(triangle[2])};
        // The normal is computed from the corners as written.
        const auto written = [&](std::size_t corner) {
            const glm::vec3& at = corners[corner];
            return glm::dvec3(widened(at.x), widened(at.y), widened(at.z));
        };
        const glm::dvec3 across = glm::cross(written(1) - written(0), written(2) - written(0));
        const double length = glm::length(across);
        put(glm::vec3(length > 0 ? across / length : glm::dvec3(0.0)));
        for (const glm::vec3& corner : corners) put(corner);
        buffer_.append(2, '\0');
        constexpr std::size_t block = 1 << 16;
        if (buffer_.size() >= block) flush();
    }
    void flush() {
        output_.write(buffer_);
        buffer_.clear();
    }

private:
    void put(std::uint32_t number) {
        for (int shift = 0; shift < 32; shift += 8) buffer_ += static_cast<char>(number >> shift & 0xff);
    }
    void put(const glm::vec3& point) {
        for (const float value : {point.x, point.y, point.z}) put(bit_cast<std::uint32_t>(value));
    }

    Output& output_;
    std::string buffer_;
};

ModelReport write_stl(const Solid& solid, const std::filesystem::path& file, Destination& destination) {
    ModelReport report;
    solid.visit([&](std::uint32_t, const SolidTriangle&) { ++report.triangles; });
    const auto output = destination.open(file);
    StlFile stl(*output, report.triangles);
    solid.visit([&](std::uint32_t, const SolidTriangle& triangle) { stl.add(triangle); });
    stl.flush();
    output->commit();
    return report;
}

/// A mesh for each colour; the first one has the corners of all.
std::vector<Mesh> meshes_of(const Solid& solid) {
    std::vector<Mesh> meshes;
    std::vector<std::size_t> mesh_of;
    for (const ReliefRegion& region : solid.regions()) {
        const auto known = std::find_if(meshes.begin(), meshes.end(),
                                        [&](const Mesh& mesh) { return mesh.colour == region.colour; });
        mesh_of.push_back(static_cast<std::size_t>(known - meshes.begin()));
        if (known == meshes.end()) meshes.push_back({.colour = region.colour, .kind = "relief"});
    }
    std::unordered_map<SolidPoint, std::uint32_t, PointHash> numbers;
    std::vector<glm::vec3> positions;
    solid.visit([&](std::uint32_t region, const SolidTriangle& triangle) {
        for (const SolidPoint& point : triangle) {
            const auto [known, is_new] = numbers.emplace(point, static_cast<std::uint32_t>(positions.size()));
            if (is_new) positions.push_back(millimetres(point));
            meshes[mesh_of[region]].corners.push_back(known->second);
        }
    });
    std::erase_if(meshes, [](const Mesh& mesh) { return mesh.corners.empty(); });
    if (!meshes.empty()) meshes.front().positions = std::move(positions);
    return meshes;
}

/// Writes a solid as STL, OBJ or glTF.
ModelReport write_solid(const Solid& solid, const Print& print, PrintFormat format, const std::filesystem::path& file,
                        const Monitor& monitor, Destination& destination) {
    if (format == PrintFormat::stl) return write_stl(solid, file, destination);
    return write_meshes(meshes_of(solid), {.is_solid = true}, print, format, file, monitor, destination);
}

}  // namespace

ReliefReport write_relief(ReliefShapes& shapes, const Print& print, const ReliefOptions& options,
                          const std::filesystem::path& file, const Monitor& monitor, Destination& destination) {
    if (shapes.shapes().empty()) throw std::runtime_error("nothing is raised: the drawing has no visible shapes");
    require_affordable(shapes, false);
    if (!print.style.fields) shapes.drop_edges(monitor);
    require_affordable(shapes, true);
    ReliefMaker maker(shapes, print, options, monitor);
    const Solid solid = maker.make();
    ReliefReport report = maker.report();
    report.volume = solid.volume();
    report.size = solid.size();
    const ModelReport written = write_solid(solid, print, options.format, file, monitor, destination);
    report.triangles = written.triangles;
    report.materials = written.materials;
    return report;
}

}  // namespace sikku
