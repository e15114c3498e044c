#include "engine/map/pressure.h"

#include "engine/map/conjugate_gradients.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace sikku {
namespace {

constexpr double largest_force = 1e-8;
constexpr int most_newton_steps = 1000;

/// Half of (b - a), turned a quarter anticlockwise: with the neighbours a and b of a vertex in a clockwise wall, the
/// derivative of the area with respect to its position.
glm::dvec2 turned(const glm::dvec2& a, const glm::dvec2& b) {
    return {0.5 * (a.y - b.y), 0.5 * (b.x - a.x)};
}

/// Energy of a map, with its first and second derivatives.
class Energy {
public:
    Energy(const Map& map, const std::vector<double>& stiffness, const std::vector<double>& contents)
        : map_(map), stiffness_(stiffness), contents_(contents) {
        // The corners of all cells in one list, each cell beginning with its last corner and ending with its first.
        for (std::size_t i = 0; i < map.cells(); ++i) {
            const auto wall = map.cell(i);
            begins_.push_back(static_cast<std::uint32_t>(corners_.size()));
            corners_.push_back(map.start(wall.back()));
            for (const HalfEdge half : wall) corners_.push_back(map.start(half));
            corners_.push_back(map.start(wall.front()));
        }
        begins_.push_back(static_cast<std::uint32_t>(corners_.size()));
        areas_.resize(map.cells());
        pressures_.resize(map.cells());
    }

    /// The energy at `vertices`; infinity if an area is not above `least` times that of the last set_point().
    double value(const VertexVector& vertices, double least) const {
        double sum = 0;
        for (std::size_t i = 0; i < map_.cells(); ++i) {
            const double area = area_of(i, vertices);
            if (!(area > least * areas_[i])) return std::numeric_limits<double>::infinity();
            sum -= contents_[i] * std::log(area);
        }
        for (std::size_t i = 0; i < map_.edges().size(); ++i) {
            const MapEdge& edge = map_.edges()[i];
            const glm::dvec2 span = vertices[edge.head] - vertices[edge.tail];
            sum += 0.5 * stiffness_[i] * glm::dot(span, span);
        }
        return sum;
    }

    /// Takes `vertices` as the point of the derivatives, and returns the forces there.
    VertexVector set_point(const VertexVector& vertices) {
        VertexVector forces(vertices.size(), glm::dvec2(0.0));
        derivatives_.resize(corners_.size());
        for (std::size_t i = 0; i < map_.cells(); ++i) {
            areas_[i] = area_of(i, vertices);
            pressures_[i] = contents_[i] / areas_[i];
            for (std::size_t k = begins_[i] + 1; k + 1 < begins_[i + 1]; ++k) {
                derivatives_[k] = turned(vertices[corners_[k - 1]], vertices[corners_[k + 1]]);
                forces[corners_[k]] += pressures_[i] * derivatives_[k];
            }
        }
        for (std::size_t i = 0; i < map_.edges().size(); ++i) {
            const MapEdge& edge = map_.edges()[i];
            const glm::dvec2 pull = stiffness_[i] * (vertices[edge.head] - vertices[edge.tail]);
            forces[edge.tail] += pull;
            forces[edge.head] -= pull;
        }
        return forces;
    }

    /// Sets `image` to the second derivative times `moved`.
    void apply(const VertexVector& moved, VertexVector& image) const {
        std::fill(image.begin(), image.end(), glm::dvec2(0.0));
        for (std::size_t i = 0; i < map_.cells(); ++i) {
            const std::size_t first = begins_[i] + 1;
            const std::size_t last = begins_[i + 1] - 1;
            double growth = 0;
            for (std::size_t k = first; k < last; ++k) growth += glm::dot(derivatives_[k], moved[corners_[k]]);
            growth *= pressures_[i] / areas_[i];
            for (std::size_t k = first; k < last; ++k) {
                image[corners_[k]] +=
                    growth * derivatives_[k] - pressures_[i] * turned(moved[corners_[k - 1]], moved[corners_[k + 1]]);
            }
        }
        for (std::size_t i = 0; i < map_.edges().size(); ++i) {
            const MapEdge& edge = map_.edges()[i];
            const glm::dvec2 pull = stiffness_[i] * (moved[edge.head] - moved[edge.tail]);
            image[edge.tail] -= pull;
            image[edge.head] += pull;
        }
    }

    /// Inverses of the 2 x 2 blocks on the diagonal of the second derivative.
    std::vector<glm::dmat2> inverse_blocks(std::size_t vertices) const {
        std::vector<glm::dmat2> blocks(vertices, glm::dmat2(0.0));
        for (std::size_t i = 0; i < map_.cells(); ++i) {
            for (std::size_t k = begins_[i] + 1; k + 1 < begins_[i + 1]; ++k) {
                blocks[corners_[k]] +=
                    pressures_[i] / areas_[i] * glm::outerProduct(derivatives_[k], derivatives_[k]);
            }
        }
        for (std::size_t i = 0; i < map_.edges().size(); ++i) {
            const MapEdge& edge = map_.edges()[i];
            if (edge.tail == edge.head) continue;
            blocks[edge.tail] += glm::dmat2(stiffness_[i]);
            blocks[edge.head] += glm::dmat2(stiffness_[i]);
        }
        for (glm::dmat2& block : blocks) block = glm::inverse(block);
        return blocks;
    }

private:
    double area_of(std::size_t cell, const VertexVector& vertices) const {
        const glm::dvec2 origin = vertices[corners_[begins_[cell]]];
        double sum = 0;
        for (std::size_t k = begins_[cell] + 1; k + 1 < begins_[cell + 1]; ++k) {
            const glm::dvec2 a = vertices[corners_[k]] - origin, b = vertices[corners_[k + 1]] - origin;
            sum += b.x * a.y - a.x * b.y;
        }
        return 0.5 * sum;
    }

    const Map& map_;
    const std::vector<double>& stiffness_;
    const std::vector<double>& contents_;
    std::vector<std::uint32_t> corners_;
    std::vector<std::uint32_t> begins_;  // of each cell in corners_
    std::vector<double> areas_;
    std::vector<double> pressures_;
    VertexVector derivatives_;  // of the area of a cell with respect to its corners
};

double largest_component(const VertexVector& forces) {
    double largest = 0;
    for (const glm::dvec2& force : forces) largest = std::max({largest, std::fabs(force.x), std::fabs(force.y)});
    return largest;
}

}  // namespace

double area_of_cell(const Map& map, std::size_t cell, const std::vector<glm::dvec2>& vertices) {
    const auto wall = map.cell(cell);
    const glm::dvec2 origin = vertices[map.start(wall.front())];
    double sum = 0;
    for (const HalfEdge half : wall) {
        const glm::dvec2 a = vertices[map.start(half)] - origin, b = vertices[map.end(half)] - origin;
        sum += b.x * a.y - a.x * b.y;
    }
    return 0.5 * sum;
}

std::vector<glm::dvec2> divided_equally(const Map& before, const MapOrigins& origins,
                                        const std::vector<glm::dvec2>& vertices) {
    std::vector<glm::dvec2> result = vertices;
    result.reserve(origins.first_vertex.back());
    for (std::size_t i = 0; i < before.edges().size(); ++i) {
        const glm::dvec2 tail = vertices[before.edges()[i].tail];
        const glm::dvec2 head = vertices[before.edges()[i].head];
        const std::uint32_t inner = origins.first_vertex[i + 1] - origins.first_vertex[i];
        for (std::uint32_t k = 1; k <= inner; ++k) {
            result.push_back(tail + (head - tail) * (static_cast<double>(k) / (inner + 1)));
        }
    }
    return result;
}

PressedMap::PressedMap(const Map& map, std::vector<glm::dvec2> vertices)
    : vertices_(std::move(vertices)), stiffness_(map.edges().size(), 1.0), contents_(map.cells(), 1.0) {}

void PressedMap::follow(const Map& before, const Map& after, const MapOrigins& origins, double growth) {
    vertices_ = divided_equally(before, origins, vertices_);
    std::vector<double> stiffness;
    stiffness.reserve(after.edges().size());
    for (std::size_t i = 0; i < stiffness_.size(); ++i) {
        const std::uint32_t parts = origins.first_edge[i + 1] - origins.first_edge[i];
        stiffness.insert(stiffness.end(), parts, stiffness_[i] * std::pow(parts, 1 - growth));
    }
    stiffness.resize(after.edges().size(), 1.0);
    stiffness_ = std::move(stiffness);
    std::vector<double> contents;
    contents.reserve(after.cells());
    for (std::size_t i = 0; i < contents_.size(); ++i) {
        const std::uint32_t daughters = origins.first_cell[i + 1] - origins.first_cell[i];
        contents.insert(contents.end(), daughters, contents_[i] * std::pow(daughters, growth - 1));
    }
    contents_ = std::move(contents);
}

std::optional<std::size_t> PressedMap::cell_without_area(const Map& map) const {
    // Relative to the square of the wall's length, so that the rounding of flat cells is not taken for an area.
    constexpr double least = 1e-12;
    for (std::size_t i = 0; i < map.cells(); ++i) {
        double length = 0;
        for (const HalfEdge half : map.cell(i))
            length += glm::length(vertices_[map.end(half)] - vertices_[map.start(half)]);
        if (!(area_of_cell(map, i, vertices_) > least * length * length)) return i;
    }
    return std::nullopt;
}

double PressedMap::energy(const Map& map) const {
    return Energy(map, stiffness_, contents_).value(vertices_, 0);
}

void PressedMap::relax(const Map& map, const Monitor& monitor) {
    // A cell never loses more than this share of its area at once: long moves would fold cells over others.
    constexpr double least_area = 0.2;
    constexpr double sufficient = 1e-4;
    Energy energy(map, stiffness_, contents_);
    VertexVector forces = energy.set_point(vertices_);
    double value = energy.value(vertices_, 0);
    double first = 0;
    for (int step = 0; largest_component(forces) >= largest_force; ++step) {
        if (step == most_newton_steps) throw std::runtime_error("the cells of the map do not come to rest");
        const double norm = std::sqrt(dot(forces, forces));
        first = std::max(first, norm);
        const double tolerance = std::min(0.1, std::sqrt(norm / first));
        const auto apply = [&](const VertexVector& moved, VertexVector& image) { energy.apply(moved, image); };
        const VertexVector direction = conjugate_gradients(apply, energy.inverse_blocks(vertices_.size()), forces,
                                                           tolerance, 10 * vertices_.size() + 100, monitor);
        const double slope = dot(forces, direction);
        VertexVector moved(vertices_.size());
        double length = 1;
        double next = 0;
        for (;; length /= 2) {
            if (length < 1e-12) throw std::runtime_error("the cells of the map do not come to rest");
            for (std::size_t i = 0; i < moved.size(); ++i) moved[i] = vertices_[i] + length * direction[i];
            next = energy.value(moved, least_area);
            if (next <= value - sufficient * length * slope + 1e-13 * std::fabs(value)) break;
        }
        vertices_ = std::move(moved);
        value = next;
        forces = energy.set_point(vertices_);
    }
}

}  // namespace sikku
