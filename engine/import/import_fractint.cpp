// Fractint expands rules depth first and executes each command when it reaches it. Its state is position, two
// headings (one of + - | for F and G, one of \ / for D and M), step length, colour, and whether ! has exchanged left
// and right; brackets save all of it. The turtle of patterns neither multiplies its step length nor exchanges sides.
// Lengths therefore become parameters, symbols that ! exchanges get counterparts, and both must be known where a
// symbol is written: the effect of each symbol on them is composed beforehand for each number of remaining steps.
#include "engine/base/text.h"
#include "engine/import/fractint_effects.h"

#include <fmt/format.h>

#include <algorithm>

namespace sikku {
namespace {

using namespace fractint;

constexpr std::size_t most_entries = 10'000;
constexpr std::size_t most_written = std::size_t{32} << 20;  // for all entries, some twice; plus 4 times the file

}  // namespace

std::vector<ImportedSystem> import_fractint(const SourcePointer& file, Diagnostics& diagnostics) {
    std::vector<ImportedSystem> systems;
    const std::string& text = file->text();
    if (!is_importable(file, "a collection of L-systems", diagnostics)) return systems;
    ImportLosses losses(file, diagnostics);
    std::size_t room = most_written + 4 * text.size();
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t line_end = find_before(text, '\n', at, text.size());
        const std::size_t brace = find_before(text, '{', at, line_end);
        if (brace == line_end || find_before(text, ';', at, brace) < brace) {
            at = line_end + 1;
            continue;
        }
        std::size_t begin = at;
        while (begin < brace && (text[begin] == ' ' || text[begin] == '\t')) ++begin;
        std::string name = text.substr(begin, brace - begin);
        name.resize(std::min(name.find_first_of(" \t(["), name.size()));
        std::size_t end = brace + 1;  // end of the entry: a brace that is not in a comment
        while (end < text.size() && text[end] != '}') {
            end = text[end] == ';' ? find_before(text, '\n', end, text.size()) : end + 1;
        }
        at = std::min(end + 1, text.size());
        if (name.empty() || lower_case(name) == "comment") continue;
        if (systems.size() >= most_entries) {
            diagnostics.unreadable({file, begin, 1}, "there are more than 10,000 entries");
            return {};
        }
        ImportedSystem system;
        system.name = printable(name, 80);
        system.line = losses.line(begin);
        if (end >= text.size()) {
            diagnostics.error({file, brace, 1}, fmt::format("the entry '{}' has no end: expected '}}'", system.name));
        } else {
            try {
                const Entry entry = read_entry(file, system.name, begin, brace + 1, end, diagnostics);
                const Effects effects(entry);
                system.pattern = write_pattern(entry, effects, file, diagnostics, losses, room);
                compile_import(system, {file, begin, 1}, diagnostics);
            } catch (const BadEntry&) {
            }
        }
        system.losses = losses.take();
        systems.push_back(std::move(system));
    }
    if (systems.empty() && !diagnostics.has_errors()) {
        diagnostics.error({file, 0, 0}, "there is no entry 'NAME {' in this file");
    }
    return systems;
}

}  // namespace sikku
