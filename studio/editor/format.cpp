#include "studio/editor/format.h"

#include "engine/base/characters.h"
#include "engine/base/text.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>

namespace sikku {
namespace {

std::size_t end_of(const Span& span) {
    return std::size_t{span.at} + span.length;
}

/// True if a line feed after this text would continue its last line: a blank and a backslash.
bool is_continued(std::string_view text) {
    return text.size() >= 2 && text.back() == '\\' && is_blank(text[text.size() - 2]);
}

class Formatter {
public:
    explicit Formatter(const Pattern& pattern) : pattern_(pattern), text_(pattern.source->text()) {}

    std::vector<TextEdit> run() {
        for (const Key& key : pattern_.keys) space_key(key);
        for (const Define& define : pattern_.defines) space(define.name, "=", define.value);
        space_productions(pattern_.common);
        for (const TableText& table : pattern_.tables) {
            space_colon(end_of(table.name));
            space_productions(table.productions);
        }
        space_productions(pattern_.interpret);
        for (const PatchText& patch : pattern_.patches) space_colon(end_of(patch.name));
        for (const Variant& variant : pattern_.variants) space_variant(variant);
        trim_lines();
        std::sort(edits_.begin(), edits_.end(),
                  [](const TextEdit& a, const TextEdit& b) { return a.begin < b.begin; });
        return std::move(edits_);
    }

private:
    void replace(std::size_t begin, std::size_t end, std::string_view wanted) {
        if (text_.substr(begin, end - begin) != wanted) edits_.push_back({begin, end, std::string(wanted)});
    }

    /// Writes a separator and the blanks around it, unless a comment or a line end is next to it.
    void space(const Span& before, std::string_view separator, const Span& after, bool is_tight = false) {
        if (before.empty() || after.empty()) return;
        const std::size_t begin = end_of(before);
        if (after.at < begin || trimmed(text_.substr(begin, after.at - begin)) != separator) return;
        replace(begin, after.at, (is_tight ? "" : " ") + std::string(separator) + " ");
    }

    /// Removes the blanks before a colon.
    void space_colon(std::size_t begin) {
        std::size_t colon = begin;
        while (colon < text_.size() && is_blank(text_[colon])) ++colon;
        if (colon < text_.size() && text_[colon] == ':') replace(begin, colon + 1, ":");
    }

    void space_key(const Key& key) {
        if (key.name_at.source != pattern_.source.get()) return;
        if (key.value.empty()) return space_colon(end_of(key.name_at));
        space(key.name_at, ":", key.value, true);
    }

    void space_productions(const std::vector<ProductionText>& productions) {
        for (const ProductionText& production : productions) {
            if (production.left) space(*production.left, "<", production.predecessor);
            Span last = production.predecessor;
            const auto follow = [&](std::string_view separator, const Span& next) {
                space(last, separator, next);
                last = next;
            };
            if (production.right) follow(">", *production.right);
            if (production.condition) follow(":", *production.condition);
            follow("-->", production.successor);
            if (production.weight) follow(":", *production.weight);
        }
    }

    void space_variant(const Variant& variant) {
        if (variant.settings.empty()) return;
        space(variant.name, ":", variant.settings.front().name_at, true);
        const Key* last = nullptr;
        for (const Key& setting : variant.settings) {
            if (last) space(last->value, ",", setting.name_at, true);
            space(setting.name_at, "=", setting.value);
            last = &setting;
        }
    }

    /// Removes blanks at the ends of lines, and ends the last one. A backslash at the end would become a
    /// continuation.
    void trim_lines() {
        for (std::size_t at = 0; at < text_.size();) {
            const std::size_t end = std::min(text_.find('\n', at), text_.size());
            std::size_t last = end;
            if (last > at && text_[last - 1] == '\r') --last;
            std::size_t kept = last;
            while (kept > at && is_blank(text_[kept - 1])) --kept;
            if (!is_continued(text_.substr(at, kept - at))) replace(kept, last, "");
            at = end + 1;
        }
        if (text_.empty() || text_.ends_with('\n') || text_.ends_with('\r') || text_.ends_with('\\')) return;
        if (!edits_.empty() && edits_.back().end == text_.size()) {
            edits_.back().text += '\n';
        } else {
            replace(text_.size(), text_.size(), "\n");
        }
    }

    const Pattern& pattern_;
    std::string_view text_;
    std::vector<TextEdit> edits_;
};

bool is_equal(const Span& a, const Span& b) {
    return a.view() == b.view();
}
bool is_equal(const std::optional<Span>& a, const std::optional<Span>& b) {
    return a.has_value() == b.has_value() && (!a || is_equal(*a, *b));
}
bool is_equal(const Key& a, const Key& b) {
    return a.name == b.name && is_equal(a.value, b.value);
}
bool is_equal(const Define& a, const Define& b) {
    return is_equal(a.name, b.name) && is_equal(a.value, b.value);
}
bool is_equal(const ProductionText& a, const ProductionText& b) {
    return is_equal(a.left, b.left) && is_equal(a.predecessor, b.predecessor) && is_equal(a.right, b.right) &&
           is_equal(a.condition, b.condition) && is_equal(a.successor, b.successor) && is_equal(a.weight, b.weight);
}
bool is_equal(const TableText& a, const TableText& b);
bool is_equal(const PatchText& a, const PatchText& b);
bool is_equal(const Variant& a, const Variant& b);
template <class Item>
bool is_equal(const std::vector<Item>& a, const std::vector<Item>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const Item& one, const Item& other) { return is_equal(one, other); });
}
bool is_equal(const TableText& a, const TableText& b) {
    return is_equal(a.name, b.name) && is_equal(a.productions, b.productions);
}
bool is_equal(const PatchText& a, const PatchText& b) {
    return is_equal(a.name, b.name) && is_equal(a.rows, b.rows);
}
bool is_equal(const Variant& a, const Variant& b) {
    return is_equal(a.name, b.name) && is_equal(a.settings, b.settings);
}
bool is_equal(const Pattern& a, const Pattern& b) {
    return is_equal(a.keys, b.keys) && is_equal(a.defines, b.defines) && is_equal(a.common, b.common) &&
           is_equal(a.tables, b.tables) && is_equal(a.interpret, b.interpret) && is_equal(a.patches, b.patches) &&
           is_equal(a.variants, b.variants);
}

}  // namespace

std::vector<TextEdit> formatting(const Pattern& pattern) {
    std::vector<TextEdit> edits = Formatter(pattern).run();
    Diagnostics diagnostics;
    const Pattern formatted =
        parse_pattern(pattern.source->name(), with_edits(pattern.source->text(), edits), diagnostics);
    if (diagnostics.is_unreadable() || !is_equal(pattern, formatted)) edits.clear();
    return edits;
}

}  // namespace sikku
