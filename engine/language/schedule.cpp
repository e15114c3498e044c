#include "engine/language/schedule.h"

#include "engine/base/characters.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace sikku {
namespace {

constexpr std::size_t most_items = std::size_t{1} << 20;  // of a schedule

std::size_t skip_blanks(std::string_view text, std::size_t at) {
    while (at < text.size() && is_blank(text[at])) ++at;
    return at;
}

/// Reads the count after the name of a table, `* COUNT`, and moves `at` past it; `1` without a count, nullopt after
/// an error.
std::optional<Span> count_at(const Span& value, std::size_t& at, Diagnostics& diagnostics) {
    static const Source once("1", "1");
    const std::string_view text = value.view();
    const std::size_t star = skip_blanks(text, at);
    if (star >= text.size() || text[star] != '*') return Span(&once, 0, 1);
    const std::size_t first = skip_blanks(text, star + 1);
    at = first;
    std::size_t depth = 0;
    while (at < text.size()) {
        if (text[at] == '(') ++depth;
        if (text[at] == ')' && depth > 0 && --depth == 0) {
            ++at;
            break;
        }
        if (depth == 0 && is_blank(text[at])) break;
        ++at;
    }
    const Span count = value.part(first, at - first);
    const std::string_view digits = count.view();
    const bool plain =
        !digits.empty() && (digits.front() == '(' || std::all_of(digits.begin(), digits.end(), continues_name));
    if (!plain) {
        return diagnostics.refuse(value.part(first),
                                  "expected a whole number, a name or an expression in parentheses after '*'");
    }
    return count;
}

}  // namespace

std::optional<std::vector<ScheduleItem>> read_schedule(const Key& key, const Pattern& pattern, const Defines& defines,
                                                       Diagnostics& diagnostics) {
    std::vector<ScheduleItem> items;
    std::vector<std::string_view> names;
    std::unordered_map<std::string_view, std::uint32_t> index;
    for (const TableText& table : pattern.tables) {
        index.emplace(table.name.view(), static_cast<std::uint32_t>(names.size()));
        names.push_back(table.name.view());
    }
    const Span& value = key.value;
    const std::string_view text = value.view();
    for (std::size_t at = skip_blanks(text, 0); at < text.size(); at = skip_blanks(text, at)) {
        const std::size_t begin = at;
        if (items.size() >= most_items) {
            return diagnostics.refuse(value.part(begin), "a schedule has at most 1,048,576 entries");
        }
        while (at < text.size() && !is_blank(text[at]) && text[at] != '*' && text[at] != ',') ++at;
        const std::string_view name = text.substr(begin, at - begin);
        const auto known = index.find(name);
        if (known == index.end()) {
            return diagnostics.refuse(
                value.part(begin),
                name.empty() ? std::string("expected the name of a table")
                             : fmt::format("unknown table '{}'{}", name, did_you_mean(nearest(name, names))));
        }
        ScheduleItem item;
        item.table = known->second;
        const auto count = count_at(value, at, diagnostics);
        if (!count) return std::nullopt;
        const auto compiled = Expression::compile(
            *count,
            [&](std::string_view wanted) -> std::optional<NameMeaning> {
                if (wanted == "n") return NameMeaning{true, 0, 0};
                return defines.find(wanted);
            },
            diagnostics);
        if (!compiled) return std::nullopt;
        item.count = *compiled;
        items.push_back(std::move(item));
    }
    if (items.empty()) return diagnostics.refuse(key.name_at, "the schedule is empty: expected the names of tables");
    return items;
}

std::optional<std::vector<ScheduleRun>> schedule_runs(std::span<const ScheduleItem> items, std::int64_t steps,
                                                      std::string* problem) {
    const double n = static_cast<double>(steps);
    std::vector<ScheduleRun> runs;
    std::int64_t missing = steps;  // counted from the end, so that the last tables are always applied
    double total = 0;
    for (const ScheduleItem& item : items) {
        const double count = std::floor(item.count.evaluate(std::span(&n, 1)));
        if (std::isnan(count)) {
            if (problem) *problem = "a count of the schedule is not a number";
            return std::nullopt;
        }
        total += std::max(count, 0.0);
        // As a double, n may be rounded up to 2^63, which is not a valid number of steps.
        const std::int64_t own = count >= n ? steps : static_cast<std::int64_t>(std::max(count, 0.0));
        if (own > 0) runs.push_back({item.table, own});
    }
    for (auto run = runs.rbegin(); run != runs.rend(); ++run) {
        run->steps = std::min(missing, run->steps);
        missing -= run->steps;
    }
    if (missing > 0) {
        if (problem) {
            *problem = fmt::format(
                "the schedule has {0} steps, but the derivation length is {1}; at most {0} can be derived", total,
                steps);
        }
        return std::nullopt;
    }
    std::erase_if(runs, [](const ScheduleRun& run) { return run.steps == 0; });
    return runs;
}

}  // namespace sikku
