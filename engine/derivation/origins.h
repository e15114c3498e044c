// engine/derivation/origins.h: traces symbols of the word back to symbols of the axiom and of productions.
#pragma once

#include "engine/base/monitor.h"
#include "engine/language/document.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace sikku {

/// A symbol in the text of a pattern: in the axiom or in a successor.
struct Origin {
    Span symbol;
    Span production;  ///< the whole production; empty for the axiom
};

/// A symbol of the derivation that leads to a symbol of the word.
struct PathStep {
    Symbol symbol = 0;
    std::uint64_t place = 0;  ///< position in the axiom or in the successor of the previous production, from 1
};

/// Traces symbols of the word, `interpret:` applied, back to the axiom.
class OriginTracer {
public:
    /// `document` must outlive it. Cost: O(symbols x steps).
    /// @throws std::runtime_error for productions with contexts, parameters or random choices, and for more than
    /// 10,000 steps
    explicit OriginTracer(const Document& document);
    ~OriginTracer();

    /// Returns the place in the pattern that a symbol of the word comes from: in the successor of the last production
    /// applied, or in the axiom; empty beyond the word. Cost: O(steps x length of the successors).
    /// @param position  in the word, counted from 1
    Origin origin(std::uint64_t position, const Monitor& monitor = {}) const;
    /// Returns the symbols that were rewritten, from the axiom to the word, and last the one that `interpret:`
    /// rewrote, if any. Symbols that stay for several steps appear once. Empty beyond the word.
    std::vector<PathStep> path(std::uint64_t position) const;

private:
    class Implementation;
    std::unique_ptr<const Implementation> implementation_;
};

/// Returns the origins of symbols at several positions. @throws as above; Stopped
std::vector<Origin> origins(const Document& document, std::span<const std::uint64_t> positions,
                            const Monitor& monitor = {});

}  // namespace sikku
