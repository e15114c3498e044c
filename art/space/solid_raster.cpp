#include "art/space/solid_raster.h"

#include "art/raster/bands.h"
#include "art/space/stage.h"
#include "art/space/triangles.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <unordered_map>
#include <utility>
#include <vector>

namespace sikku {
namespace {

constexpr int samples = 4;  // of a pixel, each way
constexpr int most_side = 500'000;
constexpr std::size_t most_entries = std::size_t{1} << 25;  // of all bins

struct Sample {
    float depth = -std::numeric_limits<float>::infinity();
    Colour colour;
};

/// A point of a surface, in samples.
struct Corner {
    glm::dvec3 at;
    double brightness;
};

/// Samples of some rows.
class Band {
public:
    Band(int width, int rows)
        : width_(width * samples), samples_(std::size_t(width_) * std::size_t(rows) * samples) {}

    /// @param top  row of samples
    void begin(int top, int rows) {
        top_ = top;
        rows_ = rows;
        std::fill(samples_.begin(), samples_.end(), Sample());
    }

    void triangle(const Corner& a, const Corner& b, const Corner& c, Colour colour) {
        const glm::dvec3 ab = b.at - a.at, ac = c.at - a.at;
        const double area = ab.x * ac.y - ab.y * ac.x;
        const int first = row(std::min({a.at.y, b.at.y, c.at.y}));
        const int end = row(std::max({a.at.y, b.at.y, c.at.y}));
        if (!(std::fabs(area) > 1e-12)) return;
        const auto slope_x = [&](double p, double q) { return (p * ac.y - q * ab.y) / area; };
        const auto slope_y = [&](double p, double q) { return (q * ab.x - p * ac.x) / area; };
        const double lb = b.brightness - a.brightness, lc = c.brightness - a.brightness;
        const double depth_x = slope_x(ab.z, ac.z), depth_y = slope_y(ab.z, ac.z);
        const double light_x = slope_x(lb, lc), light_y = slope_y(lb, lc);
        const double darkest = std::min({a.brightness, b.brightness, c.brightness});
        const double brightest = std::max({a.brightness, b.brightness, c.brightness});
        for (int y = first; y < end; ++y) {
            const double middle = y + 0.5;
            double left = std::numeric_limits<double>::infinity(), right = -left;
            const auto cut = [&](const glm::dvec3& p, const glm::dvec3& q) {
                if ((p.y <= middle) == (q.y <= middle)) return;
                const double x = p.x + (q.x - p.x) * ((middle - p.y) / (q.y - p.y));
                left = std::min(left, x);
                right = std::max(right, x);
            };
            cut(a.at, b.at);
            cut(b.at, c.at);
            cut(c.at, a.at);
            const int begin = column(left), stop = column(right);
            if (begin >= stop) continue;
            Sample* row = line(y);
            const double dx = begin + 0.5 - a.at.x, dy = middle - a.at.y;
            double depth = a.at.z + dx * depth_x + dy * depth_y;
            double light = a.brightness + dx * light_x + dy * light_y;
            for (int x = begin; x < stop; ++x, depth += depth_x, light += light_x) {
                if (static_cast<float>(depth) > row[x].depth) {
                    row[x] = {static_cast<float>(depth), lit(colour, std::clamp(light, darkest, brightest))};
                }
            }
        }
    }

    /// All that the outline runs around (non-zero winding rule), as deep as its plane.
    void polygon(std::span<const glm::dvec3> outline, const glm::dvec3& normal, double light, Colour colour) {
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
        struct Edge {
            glm::dvec3 from, to;
        };
        std::vector<Edge> edges;  // of those rows
        const int first = row(low), end = row(high);
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const Edge edge{outline[i], outline[i + 1 < outline.size() ? i + 1 : 0]};
            if (row(std::min(edge.from.y, edge.to.y)) < row(std::max(edge.from.y, edge.to.y))) edges.push_back(edge);
        }
        const Colour shaded = lit(colour, light);
        std::vector<std::pair<double, int>> cuts;  // x, and whether the edge goes up or down there
        for (int y = first; y < end; ++y) {
            const double centre = y + 0.5;
            cuts.clear();
            for (const Edge& edge : edges) {
                if ((edge.from.y <= centre) == (edge.to.y <= centre)) continue;
                const double part = (centre - edge.from.y) / (edge.to.y - edge.from.y);
                cuts.emplace_back(edge.from.x + (edge.to.x - edge.from.x) * part, edge.from.y < edge.to.y ? 1 : -1);
            }
            std::sort(cuts.begin(), cuts.end());
            int winding = 0;
            Sample* const samples_of_row = line(y);
            for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
                winding += cuts[i].second;
                if (winding == 0) continue;
                for (int x = column(cuts[i].first), stop = column(cuts[i + 1].first); x < stop; ++x) {
                    const double depth = middle.z + (x + 0.5 - middle.x) * slope_x + (centre - middle.y) * slope_y;
                    const auto kept = static_cast<float>(std::clamp(depth, farthest, nearest));
                    if (kept > samples_of_row[x].depth) samples_of_row[x] = {kept, shaded};
                }
            }
        }
    }

    template <class Brightness>
    void sphere(const glm::dvec3& centre, double radius, Colour colour, Brightness&& brightness) {
        const int first = row(centre.y - radius), end = row(centre.y + radius);
        for (int y = first; y < end; ++y) {
            const double dy = y + 0.5 - centre.y;
            const double half = std::sqrt(std::max(0.0, radius * radius - dy * dy));
            const int begin = column(centre.x - half), stop = column(centre.x + half);
            Sample* row = line(y);
            for (int x = begin; x < stop; ++x) {
                const double dx = x + 0.5 - centre.x;
                const double dz = std::sqrt(std::max(0.0, radius * radius - dx * dx - dy * dy));
                const float depth = static_cast<float>(centre.z + dz);
                if (depth > row[x].depth) row[x] = {depth, lit(colour, brightness(glm::dvec3(dx, dy, dz)))};
            }
        }
    }

    void resolve(Colour ground, int channels, std::vector<std::uint8_t>& pixels) const {
        const int width = width_ / samples;
        pixels.resize(std::size_t(width) * std::size_t(rows_ / samples) * std::size_t(channels));
        std::uint8_t* out = pixels.data();
        constexpr std::uint32_t count = samples * samples;
        for (int y = 0; y < rows_; y += samples) {
            for (int x = 0; x < width_; x += samples, out += channels) {
                std::uint32_t red = 0, green = 0, blue = 0, alpha = 0;
                for (int i = 0; i < samples; ++i) {
                    const Sample* row = samples_.data() + std::size_t(y + i) * std::size_t(width_) + std::size_t(x);
                    for (int j = 0; j < samples; ++j) {
                        const Colour colour =
                            row[j].depth < -std::numeric_limits<float>::max() ? ground : over(row[j].colour, ground);
                        red += colour.red * std::uint32_t{colour.alpha};
                        green += colour.green * std::uint32_t{colour.alpha};
                        blue += colour.blue * std::uint32_t{colour.alpha};
                        alpha += colour.alpha;
                    }
                }
                const auto mean = [&](std::uint32_t sum) {
                    return static_cast<std::uint8_t>(alpha == 0 ? 0 : (sum + alpha / 2) / alpha);
                };
                out[0] = alpha == 0 ? ground.red : mean(red);
                if (channels == 1) continue;
                out[1] = alpha == 0 ? ground.green : mean(green);
                out[2] = alpha == 0 ? ground.blue : mean(blue);
                if (channels == 4) out[3] = static_cast<std::uint8_t>((alpha + count / 2) / count);
            }
        }
    }

private:
    static Colour over(Colour upper, Colour ground) {
        if (upper.alpha == 255 || ground.alpha < 255) return upper;
        const auto mixed = [&](std::uint8_t u, std::uint8_t g) {
            return static_cast<std::uint8_t>((u * upper.alpha + g * (255 - upper.alpha) + 127) / 255);
        };
        return {mixed(upper.red, ground.red), mixed(upper.green, ground.green), mixed(upper.blue, ground.blue), 255};
    }

    /// The first row and column whose middle is not before a coordinate.
    int row(double y) const {
        return static_cast<int>(std::clamp(std::ceil(y - 0.5), double(top_), double(top_ + rows_)));
    }
    int column(double x) const {
        return static_cast<int>(std::clamp(std::ceil(x - 0.5), 0.0, static_cast<double>(width_)));
    }
    Sample* line(int y) { return samples_.data() + std::size_t(y - top_) * std::size_t(width_); }

    int width_;
    int top_ = 0, rows_ = 0;
    std::vector<Sample> samples_;
};

struct Workplace {
    Band band;
    std::vector<std::uint8_t> pixels;
};

class SolidRaster final : public Rendering {
public:
    SolidRaster(const Scene& scene, const Print& print)
        : scene_(scene),
          style_(print.style),
          size_(pixel_size(print.page, print.dpi)),
          stage_(scene, print, units(print), print.placement.step * unit(print)),
          ground_(print.style.ground.value_or(Colour{255, 255, 255, 0})) {
        if (std::max(size_.width, size_.height) > most_side) {
            throw std::runtime_error("the picture would be over 500,000 pixels wide or high");
        }
        // Powers of two, as callers ask for whole multiples of 128 rows.
        band_rows_ = size_.width > 16'384 ? 8 : size_.width > 8'192 ? 16 : 32;
        bands_ = (size_.height + band_rows_ - 1) / band_rows_;
        for (int slot = 0; slot < static_cast<int>(style_.palette.size()); ++slot) {
            line_colours_.push_back(style_.line_colour(Pen{.colour = slot}));
            fill_colours_.push_back(style_.fill_colour(Pen{.colour = slot}));
        }
        for (const ScenePolygon& polygon : scene_.polygons()) {
            // Once, and not in each band.
            if (polygon.count > 16) large_.emplace(&polygon, triangulate(scene_.vertices(polygon)));
        }
        note_channels();
        fill_bins();
    }

    int channels() const override { return channels_; }
    void watch(std::function<void()> watch) override { watch_ = std::move(watch); }

    void render(int threads, const RowSink& rows) override {
        in_bands(
            bands_, threads, [&] { return workplace(); },
            [&](Workplace& place, int band) { draw(place, band, channels_); },
            [&](const Workplace& place, int band) { deliver(place, band, rows); });
    }

    void render_rows(int first, int end, int channels, const RowSink& rows) const override {
        const auto place = workplace();
        for (int band = first / band_rows_; band * band_rows_ < end; ++band) {
            draw(*place, band, channels);
            deliver(*place, band, rows);
        }
    }

private:
    static double unit(const Print& print) { return print.dpi / 25.4 * samples; }
    static glm::dmat3x2 units(const Print& print) {
        const glm::dmat3x2& to_page = print.placement.to_page;
        return {to_page[0] * unit(print), to_page[1] * unit(print), to_page[2] * unit(print)};
    }

    std::unique_ptr<Workplace> workplace() const {
        return std::make_unique<Workplace>(Workplace{Band(size_.width, std::min(band_rows_, size_.height)), {}});
    }
    int rows_of(int band) const { return std::min(band_rows_, size_.height - band * band_rows_); }
    void deliver(const Workplace& place, int band, const RowSink& rows) const {
        rows(band * band_rows_, rows_of(band), place.pixels);
    }

    void note_channels() {
        bool has_alpha = ground_.alpha < 255;
        bool is_grey = ground_.red == ground_.green && ground_.green == ground_.blue;
        std::vector<char> lines(line_colours_.size(), 0), fills(fill_colours_.size(), 0);
        for (const SceneSegment& segment : scene_.segments()) lines[std::size_t(segment.colour)] = 1;
        for (const ScenePolygon& polygon : scene_.polygons()) fills[std::size_t(polygon.colour)] = 1;
        for (const SceneSphere& sphere : scene_.spheres()) fills[std::size_t(sphere.colour)] = 1;
        const auto note = [&](const std::vector<char>& used, const std::vector<Colour>& colours) {
            for (std::size_t i = 0; i < used.size(); ++i) {
                if (used[i])
                    is_grey = is_grey && colours[i].red == colours[i].green && colours[i].green == colours[i].blue;
            }
        };
        note(lines, line_colours_);
        note(fills, fill_colours_);
        channels_ = has_alpha ? 4 : is_grey ? 1 : 3;
    }

    // --- which band sees what ------------------------------------------------------------------------------

    std::size_t items() const {
        return scene_.segments().size() + scene_.polygons().size() + scene_.spheres().size();
    }

    /// The rows of samples that an item may touch.
    std::array<double, 2> reach(std::size_t item) const {
        if (item < scene_.segments().size()) {
            const SceneSegment& segment = scene_.segments()[item];
            const double from = stage_.place(segment.from).y, to = stage_.place(segment.to).y;
            const double before = stem_radius(segment.before, segment.from);
            const double after = stem_radius(segment.after, segment.to);
            return {std::min(from - before, to - after), std::max(from + before, to + after)};
        }
        item -= scene_.segments().size();
        if (item < scene_.polygons().size()) {
            std::array<double, 2> reach{1e300, -1e300};
            for (const glm::vec3& vertex : scene_.vertices(scene_.polygons()[item])) {
                const double y = stage_.place(vertex).y;
                reach = {std::min(reach[0], y), std::max(reach[1], y)};
            }
            return reach;
        }
        const SceneSphere& sphere = scene_.spheres()[item - scene_.polygons().size()];
        const double y = stage_.place(sphere.centre).y, radius = sphere_radius(sphere);
        return {y - radius, y + radius};
    }

    void fill_bins() {
        std::vector<std::array<int, 2>> spans(items());
        for (std::size_t item = 0; item < spans.size(); ++item) {
            const std::array<double, 2> rows = reach(item);
            const double band = band_rows_ * samples;
            // Of a row more on both sides, for what rounds.
            const auto at = [&](double y) {
                return static_cast<int>(std::clamp(std::floor(y / band), -1.0, static_cast<double>(bands_)));
            };
            const bool is_seen = rows[1] >= -1 && rows[0] <= double(size_.height) * samples + 1;
            spans[item] = {std::max(0, at(rows[0] - 1)), is_seen ? std::min(bands_ - 1, at(rows[1] + 1)) : -1};
        }
        // As many bands in a bin as keep the lists short.
        for (;; bin_bands_ *= 2) {
            std::size_t entries = 0;
            for (const auto& [first, last] : spans) {
                if (last >= first) entries += std::size_t(last / bin_bands_ - first / bin_bands_ + 1);
            }
            if (entries <= std::max(most_entries, 2 * spans.size()) || bin_bands_ >= bands_) break;
        }
        bin_begin_.assign(std::size_t(bands_ / bin_bands_) + 2, 0);
        const auto each = [&](auto&& visit) {
            for (std::size_t item = 0; item < spans.size(); ++item) {
                const auto [first, last] = spans[item];
                for (int bin = first / bin_bands_; last >= first && bin <= last / bin_bands_; ++bin) {
                    visit(std::size_t(bin), item);
                }
            }
        };
        each([&](std::size_t bin, std::size_t) { ++bin_begin_[bin + 1]; });
        for (std::size_t bin = 1; bin < bin_begin_.size(); ++bin) bin_begin_[bin] += bin_begin_[bin - 1];
        bins_.resize(bin_begin_.back());
        std::vector<std::size_t> next = bin_begin_;
        each([&](std::size_t bin, std::size_t item) { bins_[next[bin]++] = static_cast<std::uint32_t>(item); });
    }

    // --- drawing -------------------------------------------------------------------------------------------

    double stem_radius(const SceneWidth& width, const glm::vec3& at) const {
        return std::max(0.5, stage_.radius(width, at));
    }
    double sphere_radius(const SceneSphere& sphere) const { return std::max(0.5, stage_.radius(sphere)); }

    void draw(Workplace& place, int band, int channels) const {
        if (watch_) watch_();
        place.band.begin(band * band_rows_ * samples, rows_of(band) * samples);
        const std::size_t bin = std::size_t(band / bin_bands_);
        const std::size_t segments = scene_.segments().size(), polygons = scene_.polygons().size();
        for (std::size_t i = bin_begin_[bin]; i < bin_begin_[bin + 1]; ++i) {
            if (watch_ && i % 65'536 == 65'535) watch_();
            const std::size_t item = bins_[i];
            if (item < segments) {
                draw_stem(place.band, scene_.segments()[item]);
            } else if (item < segments + polygons) {
                draw_polygon(place.band, scene_.polygons()[item - segments]);
            } else {
                const SceneSphere& sphere = scene_.spheres()[item - segments - polygons];
                draw_sphere(place.band, stage_.place(sphere.centre), sphere_radius(sphere),
                            fill_colours_[std::size_t(sphere.colour)]);
            }
        }
        place.band.resolve(ground_, channels, place.pixels);
    }

    void draw_sphere(Band& band, const glm::dvec3& centre, double radius, Colour colour) const {
        band.sphere(centre, radius, colour, [this](const glm::dvec3& normal) {
            return stage_.brightness(normal.z > 0 ? normal : normal + glm::dvec3(0, 0, 1e-9));
        });
    }

    void draw_stem(Band& band, const SceneSegment& segment) const {
        const Colour colour = line_colours_[std::size_t(segment.colour)];
        const glm::dvec3 from = stage_.place(segment.from), to = stage_.place(segment.to);
        const double before = stem_radius(segment.before, segment.from);
        const double after = stem_radius(segment.after, segment.to);
        const double thickest = std::max(before, after);
        // Under a pixel and a half nobody sees how an end is made.
        const bool has_ends = thickest > 0.75 * samples;
        const glm::dvec3 along = to - from;
        const double length = glm::length(along);
        const double flat = std::hypot(along.x, along.y);
        if (has_ends || flat < 1) {
            draw_sphere(band, to, after, colour);
            if (!segment.goes_on) draw_sphere(band, from, before, colour);
        }
        if (!(flat > 0) || !(length > 0)) return;
        const glm::dvec3 ahead = along / length;
        const glm::dvec3 across(-along.y / flat, along.x / flat, 0);
        const glm::dvec3 facing = glm::cross(across, ahead);  // towards the eye, as across lies in the page
        const glm::dvec3 front = facing.z < 0 ? -facing : facing;
        if (!has_ends) {
            const double light = stage_.brightness(front);
            const Corner a{from + across * before, light}, b{from - across * before, light};
            const Corner c{to - across * after, light}, d{to + across * after, light};
            band.triangle(a, b, c, colour);
            band.triangle(a, c, d, colour);
            return;
        }
        // The half that faces the eye.
        const int sides = std::clamp(static_cast<int>(4 + 2 * std::sqrt(thickest)), 6, 48);
        const glm::dvec3 slope = ahead * ((before - after) / length);
        Corner last_from, last_to;
        for (int i = 0; i <= sides; ++i) {
            const double angle = std::numbers::pi * i / sides;
            const glm::dvec3 out = across * std::cos(angle) + front * std::sin(angle);
            const double light = stage_.brightness(out + slope);
            const Corner at_from{from + out * before, light}, at_to{to + out * after, light};
            if (i > 0) {
                band.triangle(last_from, at_from, at_to, colour);
                band.triangle(last_from, at_to, last_to, colour);
            }
            last_from = at_from;
            last_to = at_to;
        }
    }

    void draw_polygon(Band& band, const ScenePolygon& polygon) const {
        std::vector<glm::vec3> flat;
        std::vector<glm::dvec3> placed;
        for (const glm::vec3& vertex : scene_.vertices(polygon)) {
            placed.push_back(stage_.place(vertex));
            flat.emplace_back(placed.back() - placed.front());
        }
        glm::dvec3 normal = area_normal(flat);
        if (normal.z < 0) normal = -normal;
        if (!(glm::length(normal) > 0)) return;
        const double light = stage_.brightness(normal);
        const Colour colour = fill_colours_[std::size_t(polygon.colour)];
        const auto known = large_.find(&polygon);
        const Triangulation own = known == large_.end() ? triangulate(flat) : Triangulation();
        const Triangulation& parts = known == large_.end() ? own : known->second;
        if (!parts.is_whole) return band.polygon(placed, normal, light, colour);
        for (const auto& [a, b, c] : parts.triangles) {
            band.triangle({placed[a], light}, {placed[b], light}, {placed[c], light}, colour);
        }
    }

    const Scene& scene_;
    const Style style_;
    PixelSize size_;
    Stage stage_;
    Colour ground_;
    int band_rows_ = 32;
    int bands_ = 0;
    int channels_ = 3;
    std::vector<Colour> line_colours_, fill_colours_;  ///< by index of the palette
    std::unordered_map<const ScenePolygon*, Triangulation> large_;
    int bin_bands_ = 1;
    std::vector<std::size_t> bin_begin_;  ///< by bin, into bins_
    std::vector<std::uint32_t> bins_;     ///< segments, then polygons, then spheres
    std::function<void()> watch_;
};

}  // namespace

std::unique_ptr<Rendering> make_solid_raster(const Scene& scene, const Print& print) {
    return std::make_unique<SolidRaster>(scene, print);
}

}  // namespace sikku
