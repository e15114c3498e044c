#include "art/drawing/plot_scene.h"

#include "art/plotter/passes.h"
#include "art/plotter/plot.h"
#include "art/plotter/shading.h"
#include "art/space/hidden_lines.h"
#include "art/space/stage.h"
#include "art/space/tessellation.h"
#include "art/space/triangles.h"
#include "engine/base/bits.h"
#include "engine/geometry/bezier.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_set>
#include <utility>

namespace sikku {
namespace {

constexpr double thin_stem = 0.5;     // millimetres
constexpr double thinnest = 0.05;     // millimetres; least pen width for fills
constexpr double flattening = 0.005;  // millimetres; deviation of flattened curves

/// An undirected edge between two points of a scene.
struct Edge {
    std::array<glm::vec3, 2> ends;
    Edge(const glm::vec3& a, const glm::vec3& b) : ends{a, b} {
        const auto key = [](const glm::vec3& v) { return std::array{v.x, v.y, v.z}; };
        if (key(b) < key(a)) std::swap(ends[0], ends[1]);
    }
    bool operator==(const Edge&) const = default;
};
struct EdgeHash {
    std::size_t operator()(const Edge& edge) const {
        std::uint64_t hash = 0;
        for (const glm::vec3& end : edge.ends) {
            for (const float value : {end.x, end.y, end.z}) {
                // Adding 0 maps -0 to 0, so that equal numbers have equal hashes.
                hash = (hash ^ bit_cast<std::uint32_t>(value + 0.0F)) * 0x9e3779b97f4a7c15U;
                hash ^= hash >> 29;
            }
        }
        return hash;
    }
};

class ScenePlotter {
public:
    ScenePlotter(const Scene& scene, const Print& print, const PlotPen& pen, PathSink& sink, const Monitor& monitor)
        : scene_(scene),
          print_(print),
          pen_(pen),
          sink_(sink),
          monitor_(monitor),
          pulse_(monitor),
          stage_(scene, print, glm::dmat3x2(1.0), 1.0),
          step_(print.placement.step),
          fill_pens_(sikku::fill_pens(print.style)) {}

    void draw() {
        add_surfaces();
        hidden_.build(monitor_);
        draw_stems();
        for (std::size_t i = 0; i < scene_.polygons().size(); ++i) draw_polygon(i);
        for (std::size_t i = 0; i < scene_.spheres().size(); ++i) draw_sphere(i);
    }

private:
    using Owner = HiddenLines::Owner;
    // Owners are numbered in the order of draw_solids(): at equal depth, later ones cover earlier ones.
    Owner owner_of_polygon(std::size_t i) const { return static_cast<Owner>(scene_.segments().size() + i); }
    Owner owner_of_sphere(std::size_t i) const {
        return static_cast<Owner>(scene_.segments().size() + scene_.polygons().size() + i);
    }

    double before(const SceneSegment& segment) const { return stage_.radius(segment.before, segment.from); }
    double after(const SceneSegment& segment) const { return stage_.radius(segment.after, segment.to); }
    double width(const SceneSegment& segment) const { return 2 * std::max(before(segment), after(segment)) * step_; }

    /// The pen to draw with: as wide as `pen_width`, or as the style's line if that is 0.
    Pen pen(int colour, const SceneWidth& width) const {
        if (!(pen_.pen_width > 0)) return width.pen(colour);
        const StrokeWidth& stroke = print_.style.stroke;
        return {pen_.pen_width / (stroke.in_steps ? step_ : 1.0) / stroke.unit, true, colour};
    }
    int fill_colour(int colour) const { return fill_pens_[static_cast<std::size_t>(colour)]; }
    double pen_steps(const Pen& pen) const { return std::max(print_.style.line_width(pen, step_), thinnest) / step_; }

    void add_surfaces() {
        const double thin = std::max(thin_stem, pen_.pen_width * 1.001);
        for (std::size_t i = 0; i < scene_.segments().size(); ++i) {
            pulse_();
            const SceneSegment& segment = scene_.segments()[i];
            if (width(segment) <= thin) continue;
            const glm::dvec3 from = stage_.place(segment.from), to = stage_.place(segment.to);
            const glm::dvec2 flat(to - from);
            if (!(glm::length(flat) > 0)) continue;
            const glm::dvec3 side(glm::normalize(glm::dvec2(-flat.y, flat.x)), 0.0);
            const double a = before(segment), b = after(segment);
            const std::array band = {from - a * side, to - b * side, to + b * side, from + a * side};
            hidden_.add_polygon(band, static_cast<Owner>(i));
        }
        for (std::size_t i = 0; i < scene_.polygons().size(); ++i) {
            pulse_();
            const auto vertices = scene_.vertices(scene_.polygons()[i]);
            for (const auto& corners : triangulate(vertices).triangles) {
                const std::array triangle = {stage_.place(vertices[corners[0]]), stage_.place(vertices[corners[1]]),
                                             stage_.place(vertices[corners[2]])};
                hidden_.add_polygon(triangle, owner_of_polygon(i));
            }
        }
        for (std::size_t i = 0; i < scene_.spheres().size(); ++i) {
            const SceneSphere& sphere = scene_.spheres()[i];
            hidden_.add_ball(stage_.place(sphere.centre), stage_.radius(sphere), owner_of_sphere(i));
        }
    }

    /// True if the whole line is visible.
    bool is_visible(std::span<const glm::dvec3> points, Owner owner) const {
        const auto parts = hidden_.visible(points, owner, 0.0);
        return parts.size() == 1 && parts[0].size() == points.size();
    }

    void draw_line(std::span<const glm::dvec3> points, const Pen& pen, Owner owner) {
        if (points.size() < 2) return;
        pulse_();
        for (const auto& part : hidden_.visible(points, owner, 0.5 * pen_steps(pen))) {
            sink_.begin_stroke(part.front(), pen);
            sink_.lines(std::span(part).subspan(1));
            sink_.end_stroke(part.front() == part.back());
        }
    }

    std::size_t passes(const SceneSegment& segment) const {
        return pen_.pen_width > 0 ? pass_count(width(segment), pen_.pen_width) : 1;
    }

    /// Draws consecutive segments of the same colour and number of passes as one stroke.
    void draw_stems() {
        const auto& segments = scene_.segments();
        for (std::size_t first = 0; first < segments.size();) {
            std::size_t end = first + 1;
            const std::size_t count = passes(segments[first]);
            while (end < segments.size() && segments[end].goes_on && segments[end].colour == segments[first].colour &&
                   passes(segments[end]) == count) {
                pulse_();
                ++end;
            }
            const auto stem = std::span(segments).subspan(first, end - first);
            count > 1 ? draw_wide(stem, count, static_cast<Owner>(first))
                      : draw_thin(stem, static_cast<Owner>(first));
            first = end;
        }
    }

    /// Draws the middle line at the depth of the stem's front, so that a continuing stem does not hide itself.
    void draw_thin(std::span<const SceneSegment> stem, Owner owner) {
        const auto front = [&](const glm::vec3& at, double radius) {
            return stage_.place(at) + glm::dvec3(0, 0, radius);
        };
        std::vector<glm::dvec3> points = {front(stem[0].from, before(stem[0]))};
        for (const SceneSegment& segment : stem) {
            pulse_();
            points.push_back(front(segment.to, after(segment)));
        }
        draw_line(points, pen(stem[0].colour, stem[0].after), owner);
    }

    /// Fills the width of the stem in passes back and forth, with round ends.
    void draw_wide(std::span<const SceneSegment> stem, std::size_t count, Owner owner) {
        require_few_passes(stem.size(), count);
        const Pen real = pen(stem[0].colour, stem[0].after);
        const double half_pen = pen_.pen_width / 2 / step_;
        std::vector<glm::dvec3> points;
        for (std::size_t pass = 0; pass < count; ++pass) {
            const double share = 2 * static_cast<double>(pass) / static_cast<double>(count - 1) - 1;
            const double rest = std::sqrt(std::max(0.0, 1 - share * share));
            std::vector<glm::dvec3> line;
            for (std::size_t i = 0; i < stem.size(); ++i) {
                pulse_();
                const glm::dvec3 from = stage_.place(stem[i].from), to = stage_.place(stem[i].to);
                const double flat = glm::distance(glm::dvec2(from), glm::dvec2(to));
                const glm::dvec3 along = flat > 0 ? glm::dvec3(glm::dvec2(to - from) / flat, 0) : glm::dvec3(1, 0, 0);
                const glm::dvec3 side(-along.y, along.x, 0), front(0, 0, 1);
                const double a = std::max(0.0, before(stem[i]) - half_pen);
                const double b = std::max(0.0, after(stem[i]) - half_pen);
                // Stay in front of the bands that represent the stem in hidden_.
                const double above = std::max(rest, 0.2);
                const glm::dvec3 begin = from + share * a * side + above * before(stem[i]) * front;
                const glm::dvec3 end = to + share * b * side + above * after(stem[i]) * front;
                if (i == 0) line.push_back(begin - rest * a * along);
                line.push_back(begin);
                line.push_back(end);
                if (i + 1 == stem.size()) line.push_back(end + rest * b * along);
            }
            if (pass % 2 == 1) std::reverse(line.begin(), line.end());
            points.insert(points.end(), line.begin(), line.end());
        }
        draw_line(points, real, owner);
    }

    void draw_polygon(std::size_t i) {
        const ScenePolygon& polygon = scene_.polygons()[i];
        const auto vertices = scene_.vertices(polygon);
        const Pen real = pen(fill_colour(polygon.colour), SceneWidth(Pen{}));
        if (edges_.empty()) {
            for (const SceneSegment& segment : scene_.segments()) edges_.emplace(segment.from, segment.to);
        }
        std::vector<glm::dvec3> placed, line;
        for (const glm::vec3& vertex : vertices) placed.push_back(stage_.place(vertex));
        for (std::size_t k = 0; k < vertices.size(); ++k) {
            pulse_();
            const std::size_t next = (k + 1) % vertices.size();
            const bool is_inner = (polygon.inner_edges >> std::min<std::size_t>(k, 31) & 1U) != 0;
            const bool is_drawn = !is_inner && edges_.emplace(vertices[k], vertices[next]).second;
            if (is_drawn && line.empty()) line.push_back(placed[k]);
            if (is_drawn) line.push_back(placed[next]);
            if (is_drawn) continue;
            draw_line(line, real, owner_of_polygon(i));
            line.clear();
        }
        draw_line(line, real, owner_of_polygon(i));
        if (pen_.hatch) hatch(vertices, placed, real, owner_of_polygon(i));
    }

    void hatch(std::span<const glm::vec3> vertices, std::span<const glm::dvec3> placed, const Pen& pen, Owner owner) {
        if (vertices.size() < 3) return;
        std::vector<Facet> facets;
        for (const auto& corners : triangulate(vertices).triangles) {
            facets.emplace_back(placed[corners[0]], placed[corners[1]], placed[corners[2]]);
        }
        // A polygon that appears folded is hatched in its mean plane.
        const auto is_front = [](const Facet& facet) { return facet.is_seen && !facet.is_back; };
        const auto is_back = [](const Facet& facet) { return facet.is_seen && facet.is_back; };
        if (std::any_of(facets.begin(), facets.end(), is_front) &&
            std::any_of(facets.begin(), facets.end(), is_back)) {
            facets.assign(1, Facet(placed));
            if (!facets[0].is_seen) return;
        }
        const std::vector<glm::dvec2> flat(placed.begin(), placed.end());
        const double width = pen_steps(pen);
        const double spacing = pen_.hatch->spacing > 0 ? pen_.hatch->spacing / step_ : width;
        for (const glm::dvec2 along : hatch_directions(*pen_.hatch, print_.placement)) {
            for (const auto& line : hatch_lines(flat, along, spacing, width / 2, monitor_)) {
                draw_line(on_facets(line, facets), pen, owner);
            }
        }
    }

    /// A triangle on the page. shares * (x, y, 1) are barycentric coordinates, dot(plane, (x, y, 1)) is the depth.
    struct Facet {
        glm::dmat3 shares{0.0};  ///< barycentric coordinates, one row for each corner
        glm::dvec3 plane{0.0};
        double low = 0, high = 0;  ///< range of depths
        bool is_seen = false;
        bool is_back = false;  ///< clockwise on the page

        /// Covers the whole page with the mean plane of a polygon.
        explicit Facet(std::span<const glm::dvec3> polygon) {
            const std::vector<glm::vec3> vertices(polygon.begin(), polygon.end());
            const glm::dvec3 normal = area_normal(vertices);
            is_seen = std::fabs(normal.z) > 1e-3 * glm::length(normal);
            if (!is_seen) return;
            glm::dvec3 middle(0.0);
            low = high = polygon[0].z;
            for (const glm::dvec3& at : polygon) {
                middle += at / static_cast<double>(polygon.size());
                low = std::min(low, at.z);
                high = std::max(high, at.z);
            }
            const glm::dvec2 slope = -glm::dvec2(normal) / normal.z;
            plane = {slope, middle.z - glm::dot(slope, glm::dvec2(middle))};
            shares = glm::dmat3(glm::dvec3(0.0), glm::dvec3(0.0), glm::dvec3(1.0));
        }
        Facet(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
            const glm::dmat3 corners(glm::dvec3(a.x, a.y, 1), glm::dvec3(b.x, b.y, 1), glm::dvec3(c.x, c.y, 1));
            const double area = glm::determinant(corners);
            const double size = glm::distance(a, b) + glm::distance(a, c);
            is_seen = std::fabs(area) > 1e-6 * size * size;
            if (!is_seen) return;
            is_back = area < 0;
            low = std::min({a.z, b.z, c.z});
            high = std::max({a.z, b.z, c.z});
            shares = glm::inverse(corners);
            plane = glm::transpose(shares) * glm::dvec3(a.z, b.z, c.z);
        }
    };

    /// Lifts a line of the page onto a surface; adds a point where the line enters another triangle.
    std::vector<glm::dvec3> on_facets(std::span<const glm::dvec2> line, std::span<const Facet> facets) {
        std::vector<glm::dvec3> points;
        for (std::size_t i = 0; i + 1 < line.size(); ++i) {
            const glm::dvec3 a(line[i], 1), b(line[i + 1], 1);
            struct Stretch {
                double from, to;
                const Facet* facet;
            };
            std::vector<Stretch> stretches;
            for (const Facet& facet : facets) {
                pulse_();
                if (!facet.is_seen) continue;
                const glm::dvec3 at_a = facet.shares * a, at_b = facet.shares * b;
                double from = 0, to = 1;
                for (int k = 0; k < 3; ++k) {
                    if (at_a[k] < 0 && at_b[k] < 0) to = -1;
                    if ((at_a[k] < 0) == (at_b[k] < 0)) continue;
                    const double root = at_a[k] / (at_a[k] - at_b[k]);
                    (at_a[k] < 0 ? from : to) = at_a[k] < 0 ? std::max(from, root) : std::min(to, root);
                }
                if (from < to) stretches.push_back({from, to, &facet});
            }
            std::sort(stretches.begin(), stretches.end(), [](const Stretch& x, const Stretch& y) {
                return x.from != y.from ? x.from < y.from : x.to < y.to;
            });
            const auto add = [&](double t, const Facet& facet) {
                const glm::dvec3 at = a + t * (b - a);
                // Clamped: steep triangles must not be extrapolated.
                points.emplace_back(glm::dvec2(at), std::clamp(glm::dot(facet.plane, at), facet.low, facet.high));
            };
            if (stretches.empty()) {
                // Along an edge, keep the depth of the previous point.
                for (const glm::dvec3& at : {a, b}) points.emplace_back(glm::dvec2(at), depth_);
                continue;
            }
            add(0, *stretches.front().facet);
            for (std::size_t k = 1; k < stretches.size(); ++k) {
                // Coplanar neighbours need no point between them.
                const glm::dvec3 change = stretches[k].facet->plane - stretches[k - 1].facet->plane;
                if (glm::length(change) > 1e-9) add(stretches[k].from, *stretches[k].facet);
            }
            add(1, *std::max_element(stretches.begin(), stretches.end(), [](const Stretch& x, const Stretch& y) {
                        return x.to < y.to;
                    })->facet);
            depth_ = points.back().z;
        }
        return points;
    }

    void draw_sphere(std::size_t i) {
        const SceneSphere& sphere = scene_.spheres()[i];
        const Pen real = pen(fill_colour(sphere.colour), sphere.width);
        const glm::dvec3 centre = stage_.place(sphere.centre);
        const double radius = stage_.radius(sphere);
        if (!(radius > 0)) return;
        const std::vector<glm::dvec2> path = spiral(glm::dvec2(centre), radius, pen_steps(real));
        const auto on_ball = [&](glm::dvec2 at) {
            const glm::dvec2 off = at - glm::dvec2(centre);
            return glm::dvec3(at, centre.z + std::sqrt(std::max(0.0, radius * radius - glm::dot(off, off))));
        };
        std::vector<glm::dvec3> points = {on_ball(path[0])};
        for (std::size_t k = 0; k + 3 < path.size(); k += 3) {
            pulse_();
            flatten(path[k], path[k + 1], path[k + 2], path[k + 3], flattening / step_,
                    [&](glm::dvec2 end) { points.push_back(on_ball(end)); });
        }
        if (!is_visible(points, owner_of_sphere(i))) return draw_line(points, real, owner_of_sphere(i));
        sink_.begin_stroke(path.front(), real);
        sink_.curves(std::span(path).subspan(1));
        sink_.end_stroke(path.front() == path.back());
    }

    const Scene& scene_;
    const Print& print_;
    const PlotPen& pen_;
    PathSink& sink_;
    const Monitor& monitor_;
    Pulse pulse_;
    Stage stage_;
    double step_;
    std::vector<int> fill_pens_;
    HiddenLines hidden_;
    std::unordered_set<Edge, EdgeHash> edges_;  ///< edges that are drawn already
    double depth_ = 0.0;                        ///< depth of the last point of hatching
};

}  // namespace

void plot_scene(const Scene& scene, const Print& print, const PlotPen& pen, PathSink& sink, const Monitor& monitor) {
    if (scene.surfaces().empty()) return ScenePlotter(scene, print, pen, sink, monitor).draw();
    const Scene divided = tessellated(scene, {.deviation = 0.1 / print.placement.step}, monitor);
    ScenePlotter(divided, print, pen, sink, monitor).draw();
}

}  // namespace sikku
