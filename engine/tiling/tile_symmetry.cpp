#include "engine/tiling/tile_symmetry.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <unordered_map>

namespace sikku {
namespace {

/// A rotation, after a reflection if it is a mirror image: by a root of unity on a lattice, by an angle elsewhere.
struct Motion {
    bool reflects = false;
    int root = 0;
    glm::dvec2 turn{1.0, 0.0};
};

/// Rotations that differ by fewer radians are one.
constexpr double same_turn = 1e-3;

class SymmetryFinder {
public:
    SymmetryFinder(const TilePlane& plane, const TileSet& tiles, const Monitor& monitor)
        : plane_(plane), tiles_(tiles), pulse_(monitor), count_(static_cast<std::int64_t>(tiles.corner.size())) {
        for (std::uint32_t i = 0; i < tiles_.classes.size(); ++i)
            by_hash_.emplace(hash_of(tiles_.classes[i].vectors), i);
        for (const std::uint32_t point : tiles_.corner) {
            centre_ += plane_.at(point) / static_cast<double>(count_);
            if (plane_.is_exact()) plane_.add_to(sum_, point);
        }
    }

    TileSymmetry find() {
        TileSymmetry result;
        result.centre = centre_;
        if (plane_.is_exact()) {
            find_on_lattice(result);
        } else {
            find_in_doubles(result);
        }
        return result;
    }

private:
    using Vectors = std::vector<std::uint32_t>;
    /// Image of the tiles of a class under a motion.
    struct ClassImage {
        std::uint32_t in_class = 0;
        std::size_t corner = 0;  ///< the one whose image is the first corner
    };

    void find_on_lattice(TileSymmetry& result) {
        const int roots = plane_.numbers().roots();
        for (int order = roots; order > 1; --order) {
            Motion turn{false, roots / order, {}};
            if (roots % order != 0 || !maps_onto_itself(turn)) continue;
            result.rotations = static_cast<std::uint32_t>(order);
            break;
        }
        for (int root = 0; root < roots / static_cast<int>(result.rotations); ++root) {
            Motion mirror{true, root, {}};
            if (!maps_onto_itself(mirror)) continue;
            result.mirrors = result.rotations;
            break;
        }
    }

    /// Tries all motions that map the class with the fewest tiles onto others.
    void find_in_doubles(TileSymmetry& result) {
        std::vector<std::uint32_t> counts(tiles_.classes.size(), 0);
        for (const std::uint32_t in_class : tiles_.in_class) ++counts[in_class];
        const auto rarest = static_cast<std::size_t>(std::min_element(counts.begin(), counts.end()) - counts.begin());
        const TileClass& from = tiles_.classes[rarest];
        const glm::dvec2 side = unit(from.vectors.front());
        std::set<std::int64_t> tried;
        std::vector<glm::dvec2> found;  // different rotations
        for (const bool reflects : {false, true}) {
            tried.clear();
            for (std::size_t i = 0; i < counts.size(); ++i) {
                const TileClass& to = tiles_.classes[i];
                if (counts[i] != counts[rarest] || to.shape != from.shape) continue;
                for (const std::uint32_t vector : to.vectors) {
                    // The turn that maps one side onto the other; reflected sides run backwards.
                    const glm::dvec2 target = unit(vector);
                    const glm::dvec2 source = reflects ? glm::dvec2(-side.x, side.y) : side;
                    Motion motion{reflects, 0, {scalar_product(source, target), determinant(source, target)}};
                    const double angle = std::atan2(motion.turn.y, motion.turn.x);
                    const double turned = angle < -1e-5 ? angle + 2 * std::numbers::pi : angle;
                    if (!tried.insert(static_cast<std::int64_t>(std::floor(turned * 1e4 + 0.5))).second) continue;
                    if (!maps_onto_itself(motion)) continue;
                    if (reflects) {
                        result.mirrors = result.rotations;
                        return;
                    }
                    const bool is_known = std::any_of(found.begin(), found.end(), [&](glm::dvec2 turn) {
                        return std::fabs(determinant(turn, motion.turn)) < same_turn &&
                               scalar_product(turn, motion.turn) > 0;
                    });
                    if (!is_known) found.push_back(motion.turn);
                }
            }
            if (!reflects) result.rotations = std::max(static_cast<std::uint32_t>(found.size()), 1U);
        }
    }

    /// Turns by the angle between a far corner and the corner nearest to its image: the sides that suggested the
    /// motion are short, and their error grows with the distance.
    void refine(Motion& motion) {
        if (far_ == no_number) {
            double most = 0;
            for (const std::uint32_t point : tiles_.corner) {
                const glm::dvec2 arm = plane_.at(point) - centre_;
                if (scalar_product(arm, arm) > most * (1 + 1e-9)) {
                    most = scalar_product(arm, arm);
                    far_ = point;
                }
            }
        }
        if (far_ == no_number) return;
        glm::dvec2 arm = plane_.at(far_) - centre_;
        const glm::dvec2 image = turned(motion, arm);
        glm::dvec2 nearest(0.0);
        double least = std::numeric_limits<double>::max();
        for (const std::uint32_t point : tiles_.corner) {
            pulse_();
            const glm::dvec2 gap = plane_.at(point) - centre_ - image;
            if (scalar_product(gap, gap) >= least) continue;
            least = scalar_product(gap, gap);
            nearest = plane_.at(point) - centre_;
        }
        if (motion.reflects) arm.y = -arm.y;
        const double length = std::sqrt(scalar_product(arm, arm) * scalar_product(nearest, nearest));
        if (length > 0) motion.turn = {scalar_product(arm, nearest) / length, determinant(arm, nearest) / length};
    }

    /// Refines a motion of a plane that is not exact.
    bool maps_onto_itself(Motion& motion) {
        std::vector<ClassImage> images;
        for (const TileClass& each : tiles_.classes) {
            pulse_();
            const auto image = find_image(motion, each);
            if (!image) return false;
            images.push_back(*image);
        }
        if (!plane_.is_exact()) refine(motion);
        for (std::uint32_t tile = 0; tile < tiles_.tiles(); ++tile) {
            pulse_();
            const ClassImage& image = images[tiles_.in_class[tile]];
            const std::uint32_t point = moved(motion, tiles_.corner[tiles_.begin[tile] + image.corner]);
            if (point == no_number || tiles_.anchors.find(image.in_class, point) == no_number) return false;
        }
        return true;
    }

    std::optional<ClassImage> find_image(const Motion& motion, const TileClass& from) const {
        const std::size_t count = from.vectors.size();
        Vectors vectors;
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint32_t vector = motion.reflects ? turned(motion, from.vectors[count - 1 - i], true)
                                                         : turned(motion, from.vectors[i], false);
            if (vector == no_number) return std::nullopt;
            vectors.push_back(vector);
        }
        const std::size_t start = least_rotation(vectors);
        std::rotate(vectors.begin(), vectors.begin() + static_cast<std::ptrdiff_t>(start), vectors.end());
        const std::size_t corner = motion.reflects ? (count - start) % count : start;
        const auto [begin, end] = by_hash_.equal_range(hash_of(vectors));
        for (auto at = begin; at != end; ++at) {
            if (tiles_.classes[at->second].vectors == vectors) return ClassImage{at->second, corner};
        }
        return std::nullopt;
    }

    glm::dvec2 unit(std::uint32_t vector) const {
        const glm::dvec2 along = plane_.vector_at(vector);
        return along / std::sqrt(scalar_product(along, along));
    }
    static glm::dvec2 turned(const Motion& motion, glm::dvec2 at) {
        if (motion.reflects) at.y = -at.y;
        return complex_product(at, motion.turn);
    }
    /// The image of a vector, or of its opposite.
    std::uint32_t turned(const Motion& motion, std::uint32_t vector, bool opposite) const {
        if (!plane_.is_exact()) {
            const glm::dvec2 image = turned(motion, plane_.vector_at(vector));
            return plane_.find_vector({}, opposite ? -image : image);
        }
        const Cyclotomic& numbers = plane_.numbers();
        Cyclotomic::Number image = plane_.vector_coordinates(vector);
        if (motion.reflects) image = numbers.conjugate(image);
        image = numbers.rotated(image, motion.root);
        if (opposite) {
            for (std::int64_t& coordinate : image) coordinate = -coordinate;
        }
        return plane_.find_vector(image, {});
    }
    /// The image of a point about the centre, or no_number.
    std::uint32_t moved(const Motion& motion, std::uint32_t point) const {
        if (!plane_.is_exact()) return plane_.find({}, centre_ + turned(motion, plane_.at(point) - centre_));
        const Cyclotomic& numbers = plane_.numbers();
        // Multiplied by the number of corners, so that the centre is whole.
        Cyclotomic::Number image = plane_.coordinates(point);
        for (std::size_t i = 0; i < image.size(); ++i) image[i] = image[i] * count_ - sum_[i];
        if (motion.reflects) image = numbers.conjugate(image);
        image = numbers.rotated(image, motion.root);
        for (std::size_t i = 0; i < image.size(); ++i) {
            const std::int64_t scaled = image[i] + sum_[i];
            if (scaled % count_ != 0) return no_number;
            image[i] = scaled / count_;
        }
        return plane_.find(image, {});
    }

    const TilePlane& plane_;
    const TileSet& tiles_;
    Pulse pulse_;
    std::unordered_multimap<std::uint64_t, std::uint32_t> by_hash_;
    std::int64_t count_;  ///< corners, at most 2^32, so that products stay below 2^62
    Cyclotomic::Number sum_{};
    glm::dvec2 centre_{0.0};
    std::uint32_t far_ = no_number;  ///< the corner farthest from the centre
};

}  // namespace

std::string TileSymmetry::name() const {
    return (mirrors > 0 ? "D" : "C") + std::to_string(rotations);
}

TileSymmetry find_symmetry(const TilePlane& plane, const TileSet& tiles, const Monitor& monitor) {
    return SymmetryFinder(plane, tiles, monitor).find();
}

}  // namespace sikku
