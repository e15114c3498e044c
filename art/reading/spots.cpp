#include "art/reading/spots.h"

#include "engine/base/threads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

namespace sikku {
namespace {

constexpr double least_radius = 1.6;
constexpr double scale_step = 1.35;
constexpr std::size_t ring_points = 20;
/// Number of points around a spot that may be noise.
constexpr std::size_t noise_points = 2;

const std::array<glm::dvec2, ring_points>& ring_directions() {
    static const auto directions = [] {
        std::array<glm::dvec2, ring_points> list{};
        for (std::size_t i = 0; i < ring_points; ++i) {
            const double angle = 2 * std::numbers::pi * static_cast<double>(i) / ring_points;
            list[i] = {std::cos(angle), std::sin(angle)};
        }
        return list;
    }();
    return directions;
}

std::array<double, ring_points> ink_around(const GreyPicture& picture, glm::dvec2 middle, double radius) {
    const auto& directions = ring_directions();
    std::array<double, ring_points> around{};
    for (std::size_t i = 0; i < ring_points; ++i) around[i] = picture.at(middle + radius * directions[i]);
    return around;
}

}  // namespace

SpotFinder::SpotFinder(const GreyPicture& ink, const Monitor& monitor) {
    const double largest = 0.04 * static_cast<double>(std::min(ink.width, ink.height));
    for (double radius = least_radius; radius <= std::max(largest, 2 * least_radius); radius *= scale_step) {
        monitor.check();
        radii_.push_back(radius);
        blurred_.push_back(blurred(ink, 0.55 * radius));
    }
}

void SpotFinder::negate() {
    for (GreyPicture& picture : blurred_) {
        for (float& value : picture.values) value = -value;
    }
}

double SpotFinder::strength(std::size_t scale, glm::dvec2 at, double limit) const {
    const GreyPicture& picture = blurred_[scale];
    const double ring = 1.95 * radii_[scale];
    if (at.x < ring || at.y < ring || !picture.is_between_pixels(at + ring)) return 0;
    const double middle = picture.at(at);
    // Where lines cross there is much ink in the middle, but ink around it, too.
    const auto above = [middle](double around) { return middle - around - 1.5 * std::max(0.0, around); };
    // The greatest values around it; all but those that may be noise count.
    std::array<double, noise_points + 1> most;
    most.fill(-1e300);
    for (const glm::dvec2 way : ring_directions()) {
        const double around = picture.between(at + ring * way);
        if (around <= most.back()) continue;
        most.back() = around;
        for (std::size_t k = noise_points; k > 0 && most[k] > most[k - 1]; --k) std::swap(most[k], most[k - 1]);
        if (above(most.back()) <= limit) return 0;
    }
    return above(most.back());
}

void SpotFinder::find_pieces(std::vector<InkSpot>& spots, const Monitor& monitor) const {
    const GreyPicture& picture = blurred_[0];
    const std::size_t w = picture.width;
    const double largest = radii_.back();
    const auto most_pixels = static_cast<std::size_t>(4 * largest * largest);
    std::vector<std::uint8_t> is_seen(picture.values.size());
    std::vector<std::size_t> piece;
    std::uint8_t number = 0;
    // A bright place of a line is a small piece at one level, and a part of the line at the next lower one.
    constexpr std::uint8_t least_levels = 3;
    std::vector<std::uint8_t> small_at(picture.values.size());
    std::vector<std::uint8_t> small_for(picture.values.size());
    for (const float level : {0.2F, 0.3F, 0.45F, 0.67F, 1.0F, 1.5F, 2.2F}) {
        monitor.check();
        ++number;
        for (std::size_t first = 0; first < picture.values.size(); ++first) {
            if (is_seen[first] == number || picture.values[first] < level) continue;
            piece.assign(1, first);
            is_seen[first] = number;
            bool is_whole = true;  // not cut by the edge
            for (std::size_t head = 0; head < piece.size(); ++head) {
                const std::size_t at = piece[head];
                const std::size_t x = at % w;
                if (x == 0 || x + 1 == w || at < w || at + w >= picture.values.size()) {
                    is_whole = false;
                    continue;
                }
                for (const std::size_t next : {at - 1, at + 1, at - w, at + w}) {
                    if (is_seen[next] == number || picture.values[next] < level) continue;
                    is_seen[next] = number;
                    piece.push_back(next);
                }
            }
            if (!is_whole || piece.size() < 4 || piece.size() > most_pixels) continue;
            // The number of consecutive levels, up to this one, at which it was small.
            const std::uint8_t levels =
                small_at[first] + 1 == number ? static_cast<std::uint8_t>(small_for[first] + 1) : 1;
            for (const std::size_t at : piece) {
                small_at[at] = number;
                small_for[at] = levels;
            }
            if (levels < least_levels) continue;
            // The ellipse of the same moments.
            glm::dvec2 sum(0.0);
            double ink = 0;
            for (const std::size_t at : piece) {
                const double value = picture.values[at];
                sum += value * glm::dvec2(at % w, at / w);
                ink += value;
            }
            const glm::dvec2 middle = sum / ink;
            double xx = 0;
            double xy = 0;
            double yy = 0;
            for (const std::size_t at : piece) {
                const glm::dvec2 off = glm::dvec2(at % w, at / w) - middle;
                xx += off.x * off.x;
                xy += off.x * off.y;
                yy += off.y * off.y;
            }
            const auto count = static_cast<double>(piece.size());
            const double half = 0.5 * (xx + yy) / count + 1.0 / 12;
            const double apart = std::hypot(0.5 * (xx - yy), xy) / count;
            const double longest = 2 * std::sqrt(half + apart);
            const double shortest = 2 * std::sqrt(std::max(half - apart, 0.0));
            if (longest > 2.4 * shortest) continue;
            // Solid, not a ring or a bow.
            if (std::numbers::pi * longest * shortest > 1.5 * count + 3) continue;
            const double radius = std::max(std::sqrt(count / std::numbers::pi), least_radius);
            std::array<double, ring_points> around = ink_around(picture, middle, 1.8 * radius);
            std::nth_element(around.begin(), around.begin() + ring_points / 2, around.end());
            const double found = ink / count - around[ring_points / 2];
            if (found > 0.2) spots.push_back({middle, radius, found});
        }
    }
}

void SpotFinder::find_peaks(std::size_t scale, std::vector<InkSpot>& spots) const {
    const GreyPicture& picture = blurred_[scale];
    const std::size_t w = picture.width;
    for (std::size_t y = 1; y + 1 < picture.height; ++y) {
        const float* row = &picture.values[y * w];
        const float* above = row - w;
        const float* below = row + w;
        for (std::size_t x = 1; x + 1 < w; ++x) {
            const float value = row[x];
            if (value < 0.25F || value <= row[x - 1] || value < row[x + 1] || value <= above[x] || value < below[x] ||
                value <= above[x - 1] || value < below[x + 1] || value <= above[x + 1] || value < below[x - 1]) {
                continue;
            }
            const glm::dvec2 at(static_cast<double>(x), static_cast<double>(y));
            const double found = strength(scale, at, 0.2);
            if (found <= 0.2) continue;
            // The top of a parabola through three values.
            const auto offset = [](double before, double here, double after) {
                const double bend = before - 2 * here + after;
                return bend < 0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0.0;
            };
            spots.push_back(
                {at + glm::dvec2(offset(row[x - 1], value, row[x + 1]), offset(above[x], value, below[x])),
                 radii_[scale], found});
        }
    }
}

std::vector<InkSpot> SpotFinder::find(const Monitor& monitor) const {
    // The first list is of pieces, the others of peaks at a scale.
    std::vector<std::vector<InkSpot>> lists(radii_.size() + 1);
    for_each_index(lists.size(), [&](std::size_t number) {
        monitor.check();
        if (number == 0) {
            find_pieces(lists[0], monitor);
        } else {
            find_peaks(number - 1, lists[number]);
        }
    });
    std::vector<InkSpot> all;
    for (const std::vector<InkSpot>& list : lists) all.insert(all.end(), list.begin(), list.end());
    std::sort(all.begin(), all.end(), [](const InkSpot& a, const InkSpot& b) {
        if (a.strength != b.strength) return a.strength > b.strength;
        return a.at.y != b.at.y ? a.at.y < b.at.y : a.at.x < b.at.x;
    });
    // Keeps the strongest of the spots that lie within each other, by a picture of the spots' places.
    const std::size_t w = blurred_[0].width;
    const std::size_t h = blurred_[0].height;
    std::vector<char> is_taken(w * h);
    std::vector<InkSpot> spots;
    for (const InkSpot& spot : all) {
        const auto x = static_cast<std::size_t>(std::lround(spot.at.x));
        const auto y = static_cast<std::size_t>(std::lround(spot.at.y));
        if (is_taken[y * w + x] != 0) continue;
        spots.push_back(spot);
        if (spots.size() >= most_spots) break;
        const auto reach = static_cast<std::size_t>(std::ceil(2 * spot.radius));
        for (std::size_t j = y - std::min(y, reach); j <= std::min(y + reach, h - 1); ++j) {
            for (std::size_t i = x - std::min(x, reach); i <= std::min(x + reach, w - 1); ++i)
                is_taken[j * w + i] = 1;
        }
    }
    return spots;
}

InkSpot SpotFinder::near(glm::dvec2 at, double radius, double reach) const {
    InkSpot best{at, radius, 0.0};
    if (blurred_.empty() || !(reach >= 0)) return best;
    // A degenerate map of a lattice can make the reach infinite.
    reach = std::min(reach, 60.0);
    for (std::size_t scale = 0; scale < radii_.size(); ++scale) {
        if (radii_[scale] < 0.5 * radius || radii_[scale] > 2 * radius) continue;
        const double step = std::max(1.0, 0.4 * radii_[scale]);
        for (double dy = -reach; dy <= reach; dy += step) {
            for (double dx = -reach; dx <= reach; dx += step) {
                const glm::dvec2 place = at + glm::dvec2(dx, dy);
                const double found = strength(scale, place, best.strength);
                if (found > best.strength) best = {place, radii_[scale], found};
            }
        }
    }
    return best;
}

}  // namespace sikku
