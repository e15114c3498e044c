#include "art/raster/raster.h"

#include "art/raster/bands.h"
#include "art/raster/blend.h"
#include "art/raster/fill.h"
#include "art/raster/powder.h"
#include "art/raster/stream.h"
#include "art/raster/stroke.h"
#include "engine/geometry/bezier.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#if defined(__x86_64__)
#include <emmintrin.h>
#endif

namespace sikku {
namespace {

using namespace raster_stream;

// Coordinates in 1/1024 pixel stay within 31 bits with these, the widest pen's reach and a band's offset added.
constexpr int most_pixels = 500'000;
constexpr double most_radius = 250'000;
// Pens under a pixel are drawn by area, others by distance.
constexpr float thin_width = 1.0f;
// Maximum distance of curves from their chords, in pixels.
constexpr double flatness = 0.05;
// Longer lines are cut, so that single precision holds their direction.
constexpr int longest_line = 2048 * subpixels;

/// The streams of one colour (or of all polygons), one for each band; made when the colour is first used.
using Layer = std::vector<Stream>;
/// The powder in one band.
using Powder = std::vector<PowderSegment>;

/// Everything a thread needs for a band, reused for each.
struct Workplace {
    Workplace(int width, int rows, int channels)
        : canvas(width, rows, channels),
          mask_bytes(static_cast<std::size_t>(width + mask_padding) * static_cast<std::size_t>(rows + 1)),
          mask{mask_bytes.data(), width + mask_padding, width, rows} {}
    /// Made for the first polygon or thin line.
    AreaFill& area() {
        if (!area_) area_.emplace(mask.width, mask.rows);
        return *area_;
    }

    Canvas canvas;
    std::vector<std::uint8_t> mask_bytes;
    Mask mask;

private:
    std::optional<AreaFill> area_;
};

class PolygonReader {
public:
    /// @param grain  grain of powder strewn over polygons, or null
    PolygonReader(Workplace& workplace, int top, const std::vector<Colour>& colours, const PowderGrain* grain)
        : workplace_(workplace),
          area_(workplace.area()),
          top_(top * subpixels),
          colours_(colours),
          grain_(grain),
          strewn_(grain ? static_cast<std::size_t>(workplace.mask.width) : 0) {}
    ~PolygonReader() { paint(); }
    PolygonReader(const PolygonReader&) = delete;
    PolygonReader& operator=(const PolygonReader&) = delete;

    void pen(float) {}
    void polygon(std::uint32_t colour) {
        paint();
        colour_ = colours_[colour];
    }
    void move(SubPoint to) { at_ = to; }
    void line(SubPoint to) {
        constexpr double unit = 1.0 / subpixels;
        area_.edge(at_.x * unit, (at_.y - top_) * unit, to.x * unit, (to.y - top_) * unit);
        at_ = to;
    }

private:
    void paint() {
        area_.sweep([&](int row, int first, int end, int coverage) {
            if (grain_) return strew(row, first, end, coverage);
            workplace_.canvas.polygon_span(row, first, end, coverage, colour_);
        });
    }
    /// Paints a span of a row with grains.
    void strew(int row, int first, int end, int coverage) {
        std::fill(strewn_.begin() + first, strewn_.begin() + end, static_cast<std::uint8_t>(coverage));
        grain_->strew(strewn_.data(), top_ / subpixels + row, first, end);
        for (int column = first; column < end; ++column) {
            const int paint = strewn_[static_cast<std::size_t>(column)];
            if (paint > 0) workplace_.canvas.polygon_span(row, column, column + 1, paint, colour_);
        }
    }

    Workplace& workplace_;
    AreaFill& area_;
    std::int32_t top_;
    const std::vector<Colour>& colours_;
    const PowderGrain* grain_;
    std::vector<std::uint8_t> strewn_;
    Colour colour_;
    SubPoint at_;
};

class StrokeReader {
public:
    StrokeReader(Workplace& workplace, int top)
        : workplace_(workplace), stroker_(workplace.mask, top), top_(top * subpixels) {}

    void pen(float width) {
        width_ = width;
        if (width >= thin_width) stroker_.pen(width / 2);
    }
    void polygon(std::uint32_t) {}
    void move(SubPoint to) {
        at_ = to;
        if (width_ >= thin_width) stroker_.move(to);
    }
    void line(SubPoint to) {
        if (width_ >= thin_width) {
            stroker_.line(to);
        } else {
            thin_line(to);
        }
        at_ = to;
    }
    void finish() {
        stroker_.finish();
        if (!thin_) return;
        workplace_.area().sweep([&](int row, int first, int end, int coverage) {
            std::uint8_t* line = workplace_.mask.pixels + row * workplace_.mask.stride;
            for (int column = first; column < end; ++column) {
                line[column] = std::max(line[column], static_cast<std::uint8_t>(coverage));
            }
        });
    }

private:
    // A hairline is drawn as its bar of exact area, and crossing bars add up: the ink of a dense drawing is right,
    // and joints of a flattened curve are not counted twice.
    void thin_line(SubPoint to) {
        thin_ = true;
        constexpr double unit = 1.0 / subpixels;
        double x0 = at_.x * unit, y0 = (at_.y - top_) * unit;
        double x1 = to.x * unit, y1 = (to.y - top_) * unit;
        double dx = x1 - x0, dy = y1 - y0;
        const double length = std::sqrt(dx * dx + dy * dy);
        double half = 0.5 * static_cast<double>(width_);
        if (length > 0) {
            dx *= half / length;
            dy *= half / length;
        } else {
            // A dot: a square with the area of the disc.
            half *= std::sqrt(std::numbers::pi) / 2;
            x0 -= half;
            x1 += half;
            dx = half;
        }
        AreaFill& area = workplace_.area();
        area.edge(x0 + dy, y0 - dx, x0 - dy, y0 + dx);
        area.edge(x0 - dy, y0 + dx, x1 - dy, y1 + dx);
        area.edge(x1 - dy, y1 + dx, x1 + dy, y1 - dx);
        area.edge(x1 + dy, y1 - dx, x0 + dy, y0 - dx);
    }

    Workplace& workplace_;
    Stroker stroker_;
    std::int32_t top_;
    float width_ = 1;
    bool thin_ = false;
    SubPoint at_;
};

bool grey(Colour colour) {
    return colour.red == colour.green && colour.green == colour.blue;
}

class BandRaster final : public Raster {
public:
    explicit BandRaster(const Print& print);

    void begin_stroke(glm::dvec2 start, const Pen& pen) override;
    void lines(std::span<const glm::dvec2> ends) override;
    void curves(std::span<const glm::dvec2> controls) override;
    void change_pen(const Pen& pen) override;
    void end_stroke(bool closed) override;
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override;
    void area(std::span<const glm::dvec2> outline, const Pen& pen) override;
    void disc(glm::dvec2 centre, double radius, const Pen& pen) override;
    std::size_t prepare(const Blot& blot, const Pen& pen) override;
    void blot(std::size_t prepared, glm::dvec2 centre) override;

    void expect(const Pen& pen) override { line_nib(pen); }
    void powder(std::span<const PowderPoint> line, const Pen& pen, bool fills) override;
    void set_grain(double steps) override { grain_.emplace(matrix_, steps); }
    void watch(std::function<void()> watch) override { watch_ = std::move(watch); }
    int channels() const override;
    void render(int threads, const RowSink& rows) override;
    void render_rows(int first, int end, int channels, const RowSink& rows) const override;

private:
    struct Range {
        double low_x, low_y, high_x, high_y;
        bool holds(glm::dvec2 p) const { return p.x >= low_x && p.x <= high_x && p.y >= low_y && p.y <= high_y; }
    };
    /// A pen ready to draw.
    struct Nib {
        Layer* layer = nullptr;  ///< null: invisible
        float width = 0;         ///< pixels
        std::int32_t reach = 0;  ///< how far it reaches from the line's middle, in 1/1024 pixel
        Range range{};           ///< points outside of it are invisible on the page, in pixels
    };

    glm::dvec2 to_pixels(glm::dvec2 point) const {
        return {matrix_[0].x * point.x + matrix_[1].x * point.y + matrix_[2].x,
                matrix_[0].y * point.x + matrix_[1].y * point.y + matrix_[2].y};
    }
    static std::int32_t quantised(double pixels) {
#if defined(__x86_64__)
        return _mm_cvtsd_si32(_mm_set_sd(pixels * subpixels));  // same as lrint, without the call
#else
        return static_cast<std::int32_t>(std::nearbyint(pixels * subpixels));  // an instruction of WebAssembly
#endif
    }
    static SubPoint quantised(glm::dvec2 pixels) {
        return {quantised(pixels.x), quantised(pixels.y)};
    }

    Nib nib(std::vector<Layer>& layers, const std::vector<int>& slots, std::size_t index, double width);
    Nib line_nib(const Pen& pen);
    void line_to(glm::dvec2 end);
    void close_line();
    void clipped_line(glm::dvec2 from, glm::dvec2 to);
    void add(const Nib& nib, SubPoint from, SubPoint to);
    void add_piece(const Nib& nib, SubPoint from, SubPoint to);
    void add_polygon(std::size_t index);
    void polygon_edge(glm::dvec2 from, glm::dvec2 to, std::uint32_t colour);
    void add_edge(glm::dvec2 from, glm::dvec2 to, std::uint32_t colour);
    void add_blots(Mask& mask, int top, const std::vector<float>& blots) const;
    void add_powder(std::vector<Powder>& into, PowderSegment segment);
    void render_band(Workplace& workplace, int band) const;

    const Print& print_;
    PixelSize size_;
    glm::dmat3x2 matrix_;
    double millimetre_;  ///< pixels
    int band_rows_, band_bits_, bands_;
    bool transparent_;
    Colour ground_;
    std::optional<FloorPaint> floor_;

    // Colours by index, and for each index the first one of the same colour, whose layer it shares.
    std::vector<Colour> line_colours_, fill_colours_;
    std::vector<int> line_slots_, fill_slots_;
    std::vector<Layer> strokes_, discs_;
    /// A blot in pixels.
    struct Stamp {
        float* ink = nullptr;   ///< null: invisible
        glm::dvec2 half{0.0};   ///< half sides of the rectangle, in pixels
        glm::dvec2 share{0.0};  ///< 1 / side
        double area = 0;
    };
    std::vector<Stamp> stamps_;
    std::vector<std::vector<float>> blots_;  ///< by slot of the line's colour: pixels of ink for each pixel
    std::vector<std::vector<Powder>> powders_, heaps_;  ///< by slot and band
    std::optional<PowderGrain> grain_;
    Layer polygons_;
    std::vector<bool> polygon_colours_;  ///< by colour, true if used
    Arena arena_;
    std::function<void()> watch_;

    Nib nib_;
    glm::dvec2 at_{0.0};
    bool drawn_ = false;  ///< the stroke left its first point
    // If at_ is in range: its place, and the beginning of the straight line that ends there and is not added yet.
    bool has_sub_at_ = false;
    SubPoint sub_at_, open_from_;
    std::vector<glm::dvec2> polygon_points_;
    std::uint64_t polygon_serial_ = 0;
};

BandRaster::BandRaster(const Print& print) : print_(print), size_(pixel_size(print.page, print.dpi)) {
    if (size_.width > most_pixels || size_.height > most_pixels) {
        throw std::runtime_error("the print would be " + std::to_string(size_.width) + " x " +
                                 std::to_string(size_.height) + " pixels; at most " + std::to_string(most_pixels) +
                                 " per side can be drawn");
    }
    millimetre_ = print.dpi / 25.4;
    matrix_ = print.placement.to_page;
    for (int column = 0; column < 3; ++column) matrix_[column] *= millimetre_;

    // Bands of some million pixels: high enough that few lines are in two of them, small enough for the memory.
    band_rows_ = 128;
    while (band_rows_ > 32 && std::int64_t{size_.width} * band_rows_ > (1 << 22)) band_rows_ /= 2;
    band_bits_ = subpixel_bits + std::countr_zero(static_cast<unsigned>(band_rows_));
    bands_ = (size_.height + band_rows_ - 1) / band_rows_;

    ground_ = print.style.ground.value_or(Colour{255, 255, 255, 0});
    transparent_ = ground_.alpha < 255;
    if (const auto floor = print.style.shown_floor()) floor_.emplace(*floor, 1 / millimetre_, print.floor_corner);
    const int colours = std::max(static_cast<int>(print.style.palette.size()), 1);
    for (int index = 0; index < colours; ++index) {
        const Pen pen{.colour = index};
        line_colours_.push_back(print.style.line_colour(pen));
        fill_colours_.push_back(print.style.fill_colour(pen));
    }
    line_slots_ = print.style.line_slots();
    fill_slots_ = print.style.fill_slots();
    strokes_.resize(line_colours_.size());
    discs_.resize(fill_colours_.size());
    blots_.resize(line_colours_.size());
    powders_.resize(line_colours_.size());
    heaps_.resize(fill_colours_.size());
    polygon_colours_.resize(fill_colours_.size());
}

BandRaster::Nib BandRaster::nib(std::vector<Layer>& layers, const std::vector<int>& slots, std::size_t index,
                                double width) {
    Nib nib;
    if (!(width > 0)) return nib;
    width = std::min(width, 2 * most_radius);
    Layer& layer = layers[static_cast<std::size_t>(slots[index])];
    if (layer.empty()) layer.resize(static_cast<std::size_t>(bands_));
    nib.layer = &layer;
    nib.width = static_cast<float>(width);
    // The edge of a slanting line is spread over the diagonal of a pixel.
    const double reach = std::max(width, 1.0) / 2 + 0.71;
    nib.reach = static_cast<std::int32_t>(std::ceil(reach * subpixels)) + 1;
    nib.range = {-reach - 1, -reach - 1, size_.width + reach + 1, size_.height + reach + 1};
    return nib;
}

BandRaster::Nib BandRaster::line_nib(const Pen& pen) {
    const std::size_t index = static_cast<std::size_t>(print_.style.index(pen));
    if (!print_.style.draws(pen)) return {};
    return nib(strokes_, line_slots_, index, print_.style.line_width(pen, print_.placement.step) * millimetre_);
}

void BandRaster::begin_stroke(glm::dvec2 start, const Pen& pen) {
    nib_ = line_nib(pen);
    at_ = to_pixels(start);
    has_sub_at_ = false;
    drawn_ = false;
}

void BandRaster::change_pen(const Pen& pen) {
    close_line();
    nib_ = line_nib(pen);
}

void BandRaster::lines(std::span<const glm::dvec2> ends) {
    if (!nib_.layer) {
        if (!ends.empty()) at_ = to_pixels(ends.back());
        return;
    }
    for (const glm::dvec2& end : ends) line_to(to_pixels(end));
}

void BandRaster::curves(std::span<const glm::dvec2> controls) {
    if (!nib_.layer) {
        if (!controls.empty()) at_ = to_pixels(controls.back());
        return;
    }
    for (std::size_t i = 0; i + 3 <= controls.size(); i += 3) {
        const glm::dvec2 p0 = at_, p1 = to_pixels(controls[i]), p2 = to_pixels(controls[i + 1]),
                         p3 = to_pixels(controls[i + 2]);
        flatten(p0, p1, p2, p3, flatness, [this](glm::dvec2 end) { line_to(end); });
    }
}

void BandRaster::end_stroke(bool) {
    close_line();
    if (!drawn_ && nib_.layer && nib_.range.holds(at_)) add_piece(nib_, quantised(at_), quantised(at_));
    nib_ = {};
}

void BandRaster::line_to(glm::dvec2 end) {
    if (nib_.range.holds(end) && (has_sub_at_ || nib_.range.holds(at_))) [[likely]] {
        if (!has_sub_at_) {
            open_from_ = sub_at_ = quantised(at_);
            has_sub_at_ = true;
        }
        const SubPoint next = quantised(end);
        const std::int64_t dx = next.x - sub_at_.x, dy = next.y - sub_at_.y;
        if ((dx | dy) != 0) {
            // A line that continues straight extends the last one.
            const std::int64_t open_dx = sub_at_.x - open_from_.x, open_dy = sub_at_.y - open_from_.y;
            if (open_dx * dy != open_dy * dx || open_dx * dx + open_dy * dy < 0) {
                add(nib_, open_from_, sub_at_);
                open_from_ = sub_at_;
            }
            sub_at_ = next;
            drawn_ = true;
        }
    } else {
        close_line();
        drawn_ = true;
        clipped_line(at_, end);
    }
    at_ = end;
}

void BandRaster::close_line() {
    if (has_sub_at_ && !(open_from_ == sub_at_)) add(nib_, open_from_, sub_at_);
    has_sub_at_ = false;
}

void BandRaster::clipped_line(glm::dvec2 from, glm::dvec2 to) {
    // Liang and Barsky.
    double low = 0, high = 1;
    const glm::dvec2 way = to - from;
    const Range& range = nib_.range;
    const std::array<std::pair<double, double>, 4> borders{{{-way.x, from.x - range.low_x},
                                                            {way.x, range.high_x - from.x},
                                                            {-way.y, from.y - range.low_y},
                                                            {way.y, range.high_y - from.y}}};
    for (const auto& [out, room] : borders) {
        if (out == 0) {
            if (room < 0) return;
        } else if (out < 0) {
            low = std::max(low, room / out);
        } else {
            high = std::min(high, room / out);
        }
    }
    // Written so that NaN ends here, too.
    if (!(low <= high)) return;
    const glm::dvec2 first = from + low * way, last = from + high * way;
    const auto inside = [&](glm::dvec2 p) {
        return glm::dvec2(std::clamp(p.x, range.low_x, range.high_x), std::clamp(p.y, range.low_y, range.high_y));
    };
    if (!std::isfinite(first.x + first.y + last.x + last.y)) return;
    const SubPoint start = quantised(inside(first)), end = quantised(inside(last));
    if (!(start == end)) add(nib_, start, end);
}

void BandRaster::add(const Nib& nib, SubPoint from, SubPoint to) {
    const std::int64_t dx = std::int64_t{to.x} - from.x, dy = std::int64_t{to.y} - from.y;
    const std::int64_t longest = std::max(std::abs(dx), std::abs(dy));
    if (longest <= longest_line) [[likely]] {
        add_piece(nib, from, to);
        return;
    }
    const std::int64_t pieces = (longest + longest_line - 1) / longest_line;
    SubPoint start = from;
    for (std::int64_t piece = 1; piece <= pieces; ++piece) {
        const SubPoint end{static_cast<std::int32_t>(from.x + dx * piece / pieces),
                           static_cast<std::int32_t>(from.y + dy * piece / pieces)};
        add_piece(nib, start, end);
        start = end;
    }
}

void BandRaster::add_piece(const Nib& nib, SubPoint from, SubPoint to) {
    const int first = std::max((std::min(from.y, to.y) - nib.reach) >> band_bits_, 0);
    const int last = std::min((std::max(from.y, to.y) + nib.reach) >> band_bits_, bands_ - 1);
    for (int band = first; band <= last; ++band) {
        Stream& stream = (*nib.layer)[static_cast<std::size_t>(band)];
        stream.pen(arena_, nib.width);
        stream.line(arena_, from, to);
    }
}

void BandRaster::disc(glm::dvec2 centre, double radius, const Pen& pen) {
    const std::size_t index = static_cast<std::size_t>(print_.style.index(pen));
    if (fill_colours_[index].alpha == 0) return;
    const double width = 2 * print_.style.disc_radius(radius, pen, print_.placement.step) * millimetre_;
    const Nib nib = this->nib(discs_, fill_slots_, index, width);
    const glm::dvec2 at = to_pixels(centre);
    if (nib.layer && nib.range.holds(at)) add_piece(nib, quantised(at), quantised(at));
}

void BandRaster::polygon(std::span<const glm::dvec2> vertices, const Pen& pen) {
    const std::size_t index = static_cast<std::size_t>(print_.style.index(pen));
    if (fill_colours_[index].alpha == 0 || vertices.size() < 3) return;
    polygon_points_.clear();
    for (const glm::dvec2& vertex : vertices) polygon_points_.push_back(to_pixels(vertex));
    add_polygon(index);
}

void BandRaster::area(std::span<const glm::dvec2> outline, const Pen& pen) {
    const std::size_t index = static_cast<std::size_t>(print_.style.index(pen));
    if (fill_colours_[index].alpha == 0 || outline.size() < 4) return;
    polygon_points_.assign(1, to_pixels(outline.front()));
    for (std::size_t i = 1; i + 2 < outline.size(); i += 3) {
        flatten(polygon_points_.back(), to_pixels(outline[i]), to_pixels(outline[i + 1]), to_pixels(outline[i + 2]),
                flatness, [this](glm::dvec2 end) { polygon_points_.push_back(end); });
    }
    add_polygon(index);
}

/// Adds the polygon of polygon_points_.
void BandRaster::add_polygon(std::size_t index) {
    // Also false for NaN.
    const auto is_near = [](glm::dvec2 point) { return std::fabs(point.x) + std::fabs(point.y) < 1e15; };
    if (!std::all_of(polygon_points_.begin(), polygon_points_.end(), is_near)) return;
    if (polygons_.empty()) polygons_.resize(static_cast<std::size_t>(bands_));
    polygon_colours_[index] = true;
    ++polygon_serial_;
    glm::dvec2 from = polygon_points_.back();
    for (const glm::dvec2& to : polygon_points_) {
        polygon_edge(from, to, static_cast<std::uint32_t>(index));
        from = to;
    }
}

// Cuts off the parts above and below the page, and moves those left or right of it to its border, where they change
// the winding of the same rows.
void BandRaster::polygon_edge(glm::dvec2 from, glm::dvec2 to, std::uint32_t colour) {
    const double top = -1, bottom = size_.height + 1, left = -1, right = size_.width + 1;
    if (std::max(from.y, to.y) <= top || std::min(from.y, to.y) >= bottom) return;
    const auto at_y = [&](double y) {
        return glm::dvec2(from.x + (to.x - from.x) * (y - from.y) / (to.y - from.y), y);
    };
    const glm::dvec2 first = from.y < top ? at_y(top) : from.y > bottom ? at_y(bottom) : from;
    const glm::dvec2 last = to.y < top ? at_y(top) : to.y > bottom ? at_y(bottom) : to;
    // Crossings with the borders, in order along the edge.
    std::array<double, 4> cuts{0, 0, 0, 1};
    const double way = last.x - first.x;
    const auto crossing = [&](double border) {
        return way == 0 ? 0 : std::clamp((border - first.x) / way, 0.0, 1.0);
    };
    cuts[1] = crossing(left);
    cuts[2] = crossing(right);
    if (cuts[1] > cuts[2]) std::swap(cuts[1], cuts[2]);
    const auto at = [&](double t) {
        const glm::dvec2 point = t == 0 ? first : t == 1 ? last : first + t * (last - first);
        return glm::dvec2(std::clamp(point.x, left, right), point.y);
    };
    for (std::size_t piece = 0; piece < 3; ++piece) {
        if (cuts[piece] < cuts[piece + 1]) add_edge(at(cuts[piece]), at(cuts[piece + 1]), colour);
    }
}

void BandRaster::add_edge(glm::dvec2 from, glm::dvec2 to, std::uint32_t colour) {
    const SubPoint start = quantised(from), end = quantised(to);
    if (start.y == end.y) return;
    const int first = std::max(std::min(start.y, end.y) >> band_bits_, 0);
    const int last = std::min((std::max(start.y, end.y) - 1) >> band_bits_, bands_ - 1);
    for (int band = first; band <= last; ++band) {
        Stream& stream = polygons_[static_cast<std::size_t>(band)];
        stream.polygon(arena_, polygon_serial_, colour);
        stream.line(arena_, start, end);
    }
}

std::size_t BandRaster::prepare(const Blot& blot, const Pen& pen) {
    const Nib nib = line_nib(pen);
    Stamp stamp;
    if (nib.layer) {
        std::vector<float>& ink = blots_[static_cast<std::size_t>(nib.layer - strokes_.data())];
        ink.resize(static_cast<std::size_t>(size_.width) * static_cast<std::size_t>(size_.height));
        stamp.ink = ink.data();
        // An even rectangle along rows and columns with the variances of the blot.
        const auto half = [&](double a, double b) {
            const double variance = a * a * blot.spread.x + 2 * a * b * blot.spread.y + b * b * blot.spread.z;
            return std::sqrt(3 * std::max(0.0, variance));
        };
        stamp.half = {half(matrix_[0].x, matrix_[1].x), half(matrix_[0].y, matrix_[1].y)};
        stamp.share = 0.5 / glm::dvec2(std::max(stamp.half.x, 1e-9), std::max(stamp.half.y, 1e-9));
        const double step = print_.placement.step * millimetre_;
        const double width = static_cast<double>(nib.width);
        const double most = (blot.size.x * step + width) * (blot.size.y * step + width);
        stamp.area = std::min(blot.length * step * width, most);
    }
    stamps_.push_back(stamp);
    return stamps_.size() - 1;
}

void BandRaster::blot(std::size_t prepared, glm::dvec2 centre) {
    const Stamp& stamp = stamps_[prepared];
    if (!stamp.ink) return;
    const glm::dvec2 middle = to_pixels(centre);
    const glm::dvec2 low = middle - stamp.half, high = middle + stamp.half;
    // Also false for NaN.
    if (!(high.x >= 0 && high.y >= 0 && low.x < size_.width && low.y < size_.height)) return;
    const auto row_length = static_cast<std::size_t>(size_.width);
    if (low.x >= 0 && low.y >= 0 && high.x < size_.width && high.y < size_.height && stamp.half.x <= 0.5 &&
        stamp.half.y <= 0.5) [[likely]] {
        // At most two columns and two rows.
        const int x = static_cast<int>(low.x), y = static_cast<int>(low.y);
        const bool is_wide = static_cast<int>(high.x) != x, is_high = static_cast<int>(high.y) != y;
        const double left = is_wide ? (x + 1 - low.x) * stamp.share.x : 1;
        const double top = (is_high ? (y + 1 - low.y) * stamp.share.y : 1) * stamp.area;
        float* at = stamp.ink + static_cast<std::size_t>(y) * row_length + static_cast<std::size_t>(x);
        at[0] += static_cast<float>(top * left);
        if (is_wide) at[1] += static_cast<float>(top * (1 - left));
        if (is_high) {
            at += size_.width;
            const double bottom = stamp.area - top;
            at[0] += static_cast<float>(bottom * left);
            if (is_wide) at[1] += static_cast<float>(bottom * (1 - left));
        }
        return;
    }
    const auto cell = [](double at) { return static_cast<int>(std::floor(std::clamp(at, -1.0, 1e6))); };
    /// The share of the rectangle in a row or column.
    const auto share = [](int at, double from, double to, double whole) {
        if (std::floor(from) == std::floor(to)) return 1.0;
        return (std::min(at + 1.0, to) - std::max<double>(at, from)) * whole;
    };
    for (int y = std::max(cell(low.y), 0); y <= std::min(cell(high.y), size_.height - 1); ++y) {
        const double in_row = stamp.area * share(y, low.y, high.y, stamp.share.y);
        float* row = stamp.ink + static_cast<std::size_t>(y) * row_length;
        for (int x = std::max(cell(low.x), 0); x <= std::min(cell(high.x), size_.width - 1); ++x) {
            row[x] += static_cast<float>(in_row * share(x, low.x, high.x, stamp.share.x));
        }
    }
}

void BandRaster::powder(std::span<const PowderPoint> line, const Pen& pen, bool fills) {
    const std::size_t index = static_cast<std::size_t>(print_.style.index(pen));
    const std::size_t slot = static_cast<std::size_t>((fills ? fill_slots_ : line_slots_)[index]);
    if ((fills ? fill_colours_ : line_colours_)[index].alpha == 0 || line.empty() || !grain_) return;
    std::vector<Powder>& bands = (fills ? heaps_ : powders_)[slot];
    if (bands.empty()) bands.resize(static_cast<std::size_t>(bands_));
    const double step = print_.placement.step * millimetre_;
    PowderSegment segment;
    const auto start = [&](const PowderPoint& point) {
        const glm::dvec2 at = to_pixels(point.at);
        return std::array<float, 3>{static_cast<float>(at.x), static_cast<float>(at.y),
                                    static_cast<float>(std::clamp(point.half * step, 0.25, most_radius))};
    };
    const auto set = [&](const PowderPoint& a, const PowderPoint& b) {
        const auto from = start(a), to = start(b);
        segment.ax = from[0], segment.ay = from[1], segment.a_radius = from[2];
        segment.bx = to[0], segment.by = to[1], segment.b_radius = to[2];
        segment.a_height = static_cast<float>(a.height), segment.b_height = static_cast<float>(b.height);
    };
    const auto whole = [](const PowderSegment& s) {
        return static_cast<float>(powder_reach) * std::max(s.a_radius, s.b_radius);
    };
    if (line.size() == 1) {
        set(line[0], line[0]);
        segment.before = segment.after = whole(segment);
        return add_powder(bands, segment);
    }
    // Where two pieces meet each covers the wedge outside of the bend; at the ends half a disc.
    float before = 1e9f;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        set(line[i], line[i + 1]);
        segment.before = before;
        segment.after = whole(segment);
        if (i + 2 < line.size()) {
            const glm::dvec2 in = line[i + 1].at - line[i].at, out = line[i + 2].at - line[i + 1].at;
            const double lengths = std::sqrt((in.x * in.x + in.y * in.y) * (out.x * out.x + out.y * out.y));
            const double cosine = lengths > 0 ? (in.x * out.x + in.y * out.y) / lengths : -1;
            const double sine = lengths > 0 ? std::fabs(in.x * out.y - in.y * out.x) / lengths : 1;
            if (cosine > 0) segment.after = static_cast<float>(sine) * whole(segment) + 1;
        }
        before = segment.after;
        add_powder(bands, segment);
    }
}

/// Adds a segment to all bands that it reaches.
void BandRaster::add_powder(std::vector<Powder>& into, PowderSegment segment) {
    const double reach = powder_reach * static_cast<double>(std::max(segment.a_radius, segment.b_radius)) + 2;
    const double left = std::min(segment.ax, segment.bx) - reach, right = std::max(segment.ax, segment.bx) + reach;
    const double top = std::min(segment.ay, segment.by) - reach, bottom = std::max(segment.ay, segment.by) + reach;
    // Also false for NaN.
    if (!(right >= 0 && bottom >= 0 && left < size_.width && top < size_.height)) return;
    const int first = std::max(static_cast<int>(std::floor(top / band_rows_)), 0);
    const int last = std::min(static_cast<int>(bottom / band_rows_), bands_ - 1);
    for (int band = first; band <= last; ++band) into[static_cast<std::size_t>(band)].push_back(segment);
}

int BandRaster::channels() const {
    if (transparent_) return 4;
    bool all_grey = grey(ground_) && !floor_;
    for (std::size_t index = 0; index < line_colours_.size(); ++index) {
        if (!strokes_[index].empty() || !powders_[index].empty()) all_grey = all_grey && grey(line_colours_[index]);
        if (!discs_[index].empty() || !heaps_[index].empty() || polygon_colours_[index]) {
            all_grey = all_grey && grey(fill_colours_[index]);
        }
    }
    return all_grey ? 1 : 3;
}

void BandRaster::add_blots(Mask& mask, int top, const std::vector<float>& blots) const {
    const int rows = std::min(band_rows_, size_.height - top);
    for (int row = 0; row < rows; ++row) {
        const float* ink = blots.data() + static_cast<std::size_t>(top + row) * static_cast<std::size_t>(size_.width);
        std::uint8_t* line = mask.pixels + row * mask.stride;
        for (int x = 0; x < size_.width; ++x) {
            line[x] =
                static_cast<std::uint8_t>(std::min(255.0f, static_cast<float>(line[x]) + 255.0f * ink[x] + 0.5f));
        }
    }
}

void BandRaster::render_band(Workplace& workplace, int band) const {
    const int top = band * band_rows_;
    workplace.canvas.clear(ground_, std::min(band_rows_, size_.height - top));
    if (floor_) workplace.canvas.lay_floor(*floor_, top);
    const std::size_t at = static_cast<std::size_t>(band);
    if (!polygons_.empty() && !polygons_[at].empty()) {
        polygons_[at].read(PolygonReader(workplace, top, fill_colours_, grain_ ? &*grain_ : nullptr), watch_);
    }
    const auto paint = [&](const std::vector<Layer>& layers, const std::vector<Colour>& colours) {
        for (std::size_t slot = 0; slot < layers.size(); ++slot) {
            const bool has_blots = &layers == &strokes_ && !blots_[slot].empty();
            if (layers[slot].empty() || (layers[slot][at].empty() && !has_blots)) continue;
            StrokeReader reader(workplace, top);
            layers[slot][at].read(reader, watch_);
            reader.finish();
            if (has_blots) add_blots(workplace.mask, top, blots_[slot]);
            workplace.canvas.blend(workplace.mask, colours[slot]);
        }
    };
    const auto heap_up = [&](const std::vector<std::vector<Powder>>& powders, const std::vector<Colour>& colours) {
        for (std::size_t slot = 0; slot < powders.size(); ++slot) {
            if (powders[slot].empty() || powders[slot][at].empty()) continue;
            lay_powder(powders[slot][at], *grain_, workplace.mask, top, watch_);
            workplace.canvas.blend(workplace.mask, colours[slot]);
        }
    };
    paint(strokes_, line_colours_);
    heap_up(powders_, line_colours_);
    paint(discs_, fill_colours_);
    heap_up(heaps_, fill_colours_);
}

void BandRaster::render(int threads, const RowSink& rows) {
    const int channels = this->channels();
    in_bands(
        bands_, threads,
        [&] { return std::make_unique<Workplace>(size_.width, std::min(band_rows_, size_.height), channels); },
        [&](Workplace& workplace, int band) { render_band(workplace, band); },
        [&](const Workplace& workplace, int band) {
            const int top = band * band_rows_;
            rows(top, std::min(band_rows_, size_.height - top), workplace.canvas.pixels());
        });
}

void BandRaster::render_rows(int first, int end, int channels, const RowSink& rows) const {
    Workplace workplace(size_.width, std::min(band_rows_, size_.height - first), channels);
    for (int top = first; top < end; top += band_rows_) {
        render_band(workplace, top / band_rows_);
        rows(top, std::min(band_rows_, size_.height - top), workplace.canvas.pixels());
    }
}

}  // namespace

PixelSize pixel_size(const Page& page, double dpi) {
    const auto pixels = [&](double millimetres) {
        return static_cast<int>(std::clamp(std::round(millimetres / 25.4 * dpi), 1.0, 1e9));
    };
    return {pixels(page.width), pixels(page.height)};
}

std::unique_ptr<Raster> make_raster(const Print& print) {
    return std::make_unique<BandRaster>(print);
}

}  // namespace sikku
