#include "engine/tiling/tile_origins.h"

#include "engine/derivation/derivation.h"
#include "engine/geometry/turtle.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace sikku {
namespace {

constexpr std::size_t most_told = 24;  // maximum number of steps of a path in a text

/// Collects the positions in the word of the `}` of all polygons.
class PositionReader : public PolygonSink, public PlaceSink {
public:
    explicit PositionReader(std::vector<std::uint64_t>& positions) : positions_(positions) {}
    void vertices(std::span<const std::int64_t>, std::uint64_t position, bool) override { position_ = position; }
    void polygon(std::span<const glm::dvec2>, const Pen&) override {
        if (position_ == 0) return;  // the polygon was not drawn between braces
        positions_.push_back(position_);
        position_ = 0;
    }

private:
    std::vector<std::uint64_t>& positions_;
    std::uint64_t position_ = 0;
};

}  // namespace

std::unique_ptr<TileOrigins> TileOrigins::make(const Document& document, const Monitor& monitor) {
    std::unique_ptr<TileOrigins> made;
    try {
        made.reset(new TileOrigins(document));
    } catch (const Stopped&) {
        throw;
    } catch (const std::runtime_error&) {
        return nullptr;
    }
    PositionReader reader(made->positions_);
    const auto turtle = Turtle::tracing(document.grammar(), reader, reader, false);
    DerivationOptions options;
    options.interpreted = true;
    options.watch = [&monitor](std::uint64_t symbols) { monitor.advance(symbols); };
    derive(document.grammar(), *turtle, options);
    return made;
}

std::vector<PathStep> TileOrigins::path(std::uint32_t number) const {
    return number <= positions_.size() ? tracer_.path(positions_[number - 1]) : std::vector<PathStep>{};
}

std::string TileOrigins::path_text(std::uint32_t number) const {
    const std::vector<PathStep> steps = path(number);
    std::string text;
    for (std::size_t i = 0; i < std::min(steps.size(), most_told); ++i) {
        text += fmt::format("{}{} {}", i == 0 ? "" : ", ",
                            symbol_text(document_.grammar().symbols()[steps[i].symbol]), steps[i].place);
    }
    return steps.size() > most_told ? text + ", …" : text;
}

std::optional<TileOrigin> TileOrigins::origin(std::uint32_t number) const {
    if (number > positions_.size()) return std::nullopt;
    const Span symbol = tracer_.origin(positions_[number - 1]).symbol;
    if (!symbol.source) return std::nullopt;
    const Place place = symbol.source->place(symbol.at);
    return TileOrigin{place.line, place.column, path_text(number)};
}

void find_origins(const Document& document, TilingExamination& examination, const Monitor& monitor) {
    if (examination.violations.list.empty()) return;
    const auto origins = TileOrigins::make(document, monitor);
    if (!origins) return;
    for (TileViolation& violation : examination.violations.list) {
        for (const std::uint32_t number : {violation.other, violation.tile}) {
            if (number == 0) continue;
            if (auto origin = origins->origin(number)) violation.origins.push_back(std::move(*origin));
        }
    }
}

}  // namespace sikku
