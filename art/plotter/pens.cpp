#include "art/plotter/pens.h"

#include <algorithm>
#include <limits>

namespace sikku {
namespace {

constexpr double most_work = 1e9;  // maximum work of one round of exchanges

class Medoids {
public:
    explicit Medoids(std::span<const PenColour> colours) : colours_(colours) {
        const std::size_t count = colours.size();
        distances_.resize(count * count);
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t k = 0; k < count; ++k) {
                distances_[i * count + k] = colour_distance(colours[i].colour, colours[k].colour);
            }
            pens_.push_back(i);
        }
    }

    /// Removes the pen whose loss costs least, until `most` are left.
    void remove(std::size_t most) {
        while (pens_.size() > most) {
            // The cost of drawing with the second nearest pen instead.
            std::vector<double> cost(colours_.size());
            for (std::size_t i = 0; i < colours_.size(); ++i) {
                const std::size_t first = nearest(i, pens_);
                double second = std::numeric_limits<double>::infinity();
                for (const std::size_t pen : pens_) {
                    if (pen != first) second = std::min(second, distance(i, pen));
                }
                cost[first] += colours_[i].drawn * (second - distance(i, first));
            }
            pens_.erase(std::min_element(pens_.begin(), pens_.end(),
                                         [&](std::size_t a, std::size_t b) { return cost[a] < cost[b]; }));
        }
    }

    /// Exchanges pens for other colours while that lowers the cost.
    void exchange() {
        const auto tries = static_cast<double>(pens_.size() * colours_.size());
        if (tries * tries > most_work) return;
        double least = cost_of(pens_);
        for (bool changed = true; changed;) {
            changed = false;
            for (std::size_t i = 0; i < pens_.size(); ++i) {
                for (std::size_t k = 0; k < colours_.size(); ++k) {
                    std::vector<std::size_t> other = pens_;
                    other[i] = k;
                    const double cost = cost_of(other);
                    if (!(cost < least * (1 - 1e-12))) continue;
                    least = cost;
                    pens_ = std::move(other);
                    changed = true;
                }
            }
        }
    }

    std::size_t nearest(std::size_t colour, const std::vector<std::size_t>& pens) const {
        return *std::min_element(pens.begin(), pens.end(), [&](std::size_t a, std::size_t b) {
            return distance(colour, a) != distance(colour, b) ? distance(colour, a) < distance(colour, b) : a < b;
        });
    }
    const std::vector<std::size_t>& pens() const { return pens_; }

private:
    double distance(std::size_t i, std::size_t k) const { return distances_[i * colours_.size() + k]; }
    double cost_of(const std::vector<std::size_t>& pens) const {
        double sum = 0;
        for (std::size_t i = 0; i < colours_.size(); ++i) {
            sum += colours_[i].drawn * distance(i, nearest(i, pens));
        }
        return sum;
    }

    std::span<const PenColour> colours_;
    std::vector<double> distances_;
    std::vector<std::size_t> pens_;
};

}  // namespace

std::vector<std::size_t> merge_pens(std::span<const PenColour> colours, std::size_t most) {
    Medoids medoids(colours);
    medoids.remove(most);
    medoids.exchange();
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < colours.size(); ++i) result.push_back(medoids.nearest(i, medoids.pens()));
    return result;
}

}  // namespace sikku
