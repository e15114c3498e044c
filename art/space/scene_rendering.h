// art/space/scene_rendering.h: the common base of renderings of scenes: samples in bands, colours, and iteration over
// the items of a band.
#pragma once

#include "art/raster/bands.h"
#include "art/space/large_array.h"
#include "art/space/outline_runs.h"
#include "art/space/scene_bands.h"
#include "art/space/stage.h"
#include "art/space/tessellation.h"
#include "art/space/triangles.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

namespace sikku {

/// Samples of some rows of a picture. Untouched stretches cost nothing.
template <class Sample>
class SampleBand {
public:
    static constexpr int stretch = 32 * SceneBands::samples;  ///< samples

    /// @param width, rows  in pixels
    SampleBand(int width, int rows)
        : width_(width * SceneBands::samples),
          stretches_(std::size_t((width_ + stretch - 1) / stretch)),
          size_(std::size_t(width_) * std::size_t(rows) * SceneBands::samples),
          memory_(size_),
          samples_(memory_.part(0, size_)),
          touched_(stretches_ * std::size_t(rows), 1) {}

    /// @param top  row of samples
    void begin(int top, int rows) {
        top_ = top;
        rows_ = rows;
        for (std::size_t i = 0; i < touched_.size(); ++i) {
            if (touched_[i]) empty(static_cast<int>(i / stretches_), static_cast<int>(i % stretches_));
        }
        std::fill(touched_.begin(), touched_.end(), char{0});
    }
    /// Whether there may be something in the stretch around a sample of a row that counts from that of begin().
    bool is_touched(int x, int y) const { return touched_[number(x, y)] != 0; }
    int top() const { return top_; }
    int rows() const { return rows_; }
    int width() const { return width_; }
    std::span<const Sample> row(int y) const {
        return samples_.subspan(std::size_t(y) * std::size_t(width_), std::size_t(width_));
    }

protected:
    /// Calls `visit(y, row, begin, end)` for each row of samples within a triangle.
    template <class Visit>
    void each_run(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, Visit&& visit) {
        const int first = row_after(std::min({a.y, b.y, c.y})), end = row_after(std::max({a.y, b.y, c.y}));
        if (first == end) return;
        const TriangleRuns<glm::dvec3> runs(a, b, c);
        for (int y = first; y < end; ++y) {
            const auto [left, right] = runs.at(y + 0.5);
            const int begin = column_after(left), stop = column_after(right);
            if (begin >= stop) continue;
            touch(y, begin, stop);
            visit(y, line(y), begin, stop);
        }
    }

    /// Calls `visit(sample, depth)` for each sample within the outline, with the depth of its plane.
    template <class Visit>
    void each_of_outline(std::span<const glm::dvec3> outline, const glm::dvec3& normal, Visit&& visit) {
        glm::dvec3 middle(0.0);
        double nearest = -1e300, farthest = 1e300, low = 1e300, high = -1e300;
        for (const glm::dvec3& corner : outline) {
            middle += corner / static_cast<double>(outline.size());
            nearest = std::max(nearest, corner.z);
            farthest = std::min(farthest, corner.z);
            low = std::min(low, corner.y);
            high = std::max(high, corner.y);
        }
        const double slope_x = -normal.x / normal.z, slope_y = -normal.y / normal.z;
        each_outline_run(outline, row_after(low), row_after(high), [&](int y, double from, double to) {
            Sample* const row = line(y);
            const int begin = column_after(from), stop = column_after(to);
            touch(y, begin, stop);
            for (int x = begin; x < stop; ++x) {
                const double depth = middle.z + (x + 0.5 - middle.x) * slope_x + (y + 0.5 - middle.y) * slope_y;
                visit(row[x], static_cast<float>(std::clamp(depth, farthest, nearest)));
            }
        });
    }

    /// Calls `visit(sample, out)` for each sample within a ball, with the outward direction there, as long as the
    /// radius.
    template <class Visit>
    void each_of_ball(const glm::dvec3& centre, double radius, Visit&& visit) {
        for (int y = row_after(centre.y - radius), end = row_after(centre.y + radius); y < end; ++y) {
            const double dy = y + 0.5 - centre.y;
            const double half = std::sqrt(std::max(0.0, radius * radius - dy * dy));
            Sample* const row = line(y);
            const int begin = column_after(centre.x - half), stop = column_after(centre.x + half);
            touch(y, begin, stop);
            for (int x = begin; x < stop; ++x) {
                const double dx = x + 0.5 - centre.x;
                visit(row[x], glm::dvec3(dx, dy, std::sqrt(std::max(0.0, radius * radius - dx * dx - dy * dy))));
            }
        }
    }

    /// The first row and column whose middle is not before a coordinate.
    int row_after(double y) const {
        return static_cast<int>(std::clamp(std::ceil(y - 0.5), double(top_), double(top_ + rows_)));
    }
    int column_after(double x) const {
        return static_cast<int>(std::clamp(std::ceil(x - 0.5), 0.0, static_cast<double>(width_)));
    }
    Sample* line(int y) { return samples_.data() + std::size_t(y - top_) * std::size_t(width_); }

private:
    std::size_t number(int x, int y) const {
        return std::size_t(y / SceneBands::samples) * stretches_ + std::size_t(x / stretch);
    }
    /// Notes that samples of a row, counted from the top of the page, may be written.
    void touch(int y, int begin, int stop) {
        for (int x = begin / stretch * stretch; x < stop; x += stretch) touched_[number(x, y - top_)] = 1;
    }
    /// @param line  row of pixels
    void empty(int line, int piece) {
        const int left = piece * stretch, right = std::min(width_, left + stretch);
        for (int y = line * SceneBands::samples; y < (line + 1) * SceneBands::samples; ++y) {
            Sample* const row = samples_.data() + std::size_t(y) * std::size_t(width_);
            std::fill(row + left, row + right, Sample());
        }
    }

    int width_;
    int top_ = 0, rows_ = 0;
    std::size_t stretches_;  ///< of a row
    std::size_t size_;
    LargeArray<Sample> memory_;  ///< in large pages: a surface covers many rows
    std::span<Sample> samples_;
    std::vector<char> touched_;  ///< stretches of rows of pixels
};

/// A rendering of a scene, with surfaces divided to the resolution of its pixels.
template <class Band>
class SceneRendering : public Rendering {
public:
    void watch(std::function<void()> watch) override { watch_ = std::move(watch); }

    void render(int threads, const RowSink& rows) override {
        prepare(threads);
        in_bands(
            bands_.count(), threads, [&] { return workplace(); },
            [&](Workplace& place, int band) { draw(place, band, channels()); },
            [&](const Workplace& place, int band) { deliver(place, band, rows); });
    }

    void render_rows(int first, int end, int channels, const RowSink& rows) const override {
        prepare(1);
        const auto place = workplace();
        for (int band = first / bands_.height(); band * bands_.height() < end; ++band) {
            draw(*place, band, channels);
            deliver(*place, band, rows);
        }
    }

protected:
    /// @param fineness  of surfaces, in turtle steps
    SceneRendering(const Scene& scene, const Print& print, double widening, const Fineness& fineness)
        : own_(scene.surfaces().empty() ? Scene() : tessellated(scene, fineness)),
          scene_(scene.surfaces().empty() ? scene : own_),
          style_(print.style),
          size_(solid_picture_size(print)),
          stage_(picture_stage(scene_, print)),
          bands_(scene_, stage_, size_, widening),
          ground_(print.style.ground.value_or(Colour{255, 255, 255, 0})) {
        for (int slot = 0; slot < static_cast<int>(style_.palette.size()); ++slot) {
            line_colours_.push_back(style_.line_colour(Pen{.colour = slot}));
            fill_colours_.push_back(style_.fill_colour(Pen{.colour = slot}));
        }
        for (const ScenePolygon& polygon : scene_.polygons()) {
            // Once, instead of in each band.
            if (polygon.count > 16) large_.emplace(&polygon, triangulate(scene_.vertices(polygon)));
        }
    }

    virtual void prepare(int /*threads*/) const {}
    virtual void draw_stem(Band& band, std::size_t index) const = 0;
    virtual void draw_polygon(Band& band, const ScenePolygon& polygon) const = 0;
    virtual void draw_sphere(Band& band, const SceneSphere& sphere) const = 0;
    virtual void resolve(const Band& band, int channels, std::vector<std::uint8_t>& pixels) const = 0;

    /// A deviation of a fifth of a pixel, in turtle steps.
    static double fine_deviation(const Print& print) { return 0.2 * 25.4 / print.dpi / print.placement.step; }

    /// Triangles of a polygon. @param own  receives them if they are not stored
    const Triangulation& triangles_of(const ScenePolygon& polygon, std::span<const glm::vec3> vertices,
                                      Triangulation& own) const {
        const auto known = large_.find(&polygon);
        if (known != large_.end()) return known->second;
        own = triangulate(vertices);
        return own;
    }

    const Scene own_;  ///< the scene with its surfaces divided, if it has any
    const Scene& scene_;
    const Style style_;
    PixelSize size_;
    Stage stage_;
    SceneBands bands_;
    Colour ground_;
    std::vector<Colour> line_colours_, fill_colours_;  ///< by index of the palette
    std::function<void()> watch_;

private:
    struct Workplace {
        Band band;
        std::vector<std::uint8_t> pixels;
    };

    std::unique_ptr<Workplace> workplace() const {
        return std::make_unique<Workplace>(Workplace{Band(size_.width, bands_.height()), {}});
    }
    void deliver(const Workplace& place, int band, const RowSink& rows) const {
        rows(band * bands_.height(), bands_.rows(band), place.pixels);
    }

    void draw(Workplace& place, int band, int channels) const {
        if (watch_) watch_();
        place.band.begin(band * bands_.height() * SceneBands::samples, bands_.rows(band) * SceneBands::samples);
        for (std::size_t i = 0, end = bands_.items(band); i < end; ++i) {
            if (watch_ && i % 65'536 == 65'535) watch_();
            const SceneItem item = bands_.item(band, i);
            if (item.kind == SceneItem::Kind::segment) {
                draw_stem(place.band, item.index);
            } else if (item.kind == SceneItem::Kind::polygon) {
                draw_polygon(place.band, scene_.polygons()[item.index]);
            } else {
                draw_sphere(place.band, scene_.spheres()[item.index]);
            }
        }
        resolve(place.band, channels, place.pixels);
    }

    std::unordered_map<const ScenePolygon*, Triangulation> large_;
};

}  // namespace sikku
