// art/gallery/keys.h: the keys and formats that galleries accept, derived from the interpreters' tables.
#pragma once

#include "art/gallery/patterns.h"
#include "engine/base/option.h"
#include "engine/interpreter.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// A key of gallery files, and an option of the command line.
struct GalleryKey {
    std::string name{};
    std::string help{};
    std::string_view unit{};           ///< may follow the number
    const Interpreter* use = nullptr;  ///< interpreter whose jobs use the key; null: all
    OptionKind kind = OptionKind::text;
    bool overrides = false;  ///< true if it overrides a key of the pattern
    double least = -1e300;
    double most = 1e300;
    bool is_option = true;            ///< it is also an option of the command line
    bool has_optional_value = false;  ///< `true` stands for its default
    bool sets_scale = false;          ///< excludes the other keys that do
};

/// The keys and formats that gallery files may contain.
class GalleryKeys {
public:
    /// @param interpreters  in order of precedence for formats of the same name: prints, then scores
    /// @param pieces  reads arrangements; without it, galleries make files of patterns only
    explicit GalleryKeys(std::vector<const Interpreter*> interpreters, PieceReader pieces = {});

    const std::vector<GalleryKey>& list() const { return keys_; }
    /// Finds a key by its name; null if it is unknown.
    const GalleryKey* find(std::string_view name) const;
    /// Reason why an option of an interpreter is not a key; empty if there is no such option.
    std::string not_a_key(std::string_view name) const;
    /// Names of all formats whose jobs are one file each, without aliases: `svg, pdf, …`.
    std::string format_list() const;
    /// Names and aliases of all formats whose jobs are one file each.
    const std::vector<std::string_view>& formats() const { return formats_; }
    /// @param format  one of formats()
    const Interpreter& interpreter_of(std::string_view format) const;
    /// Label of a format in a link, `MIDI`. @param format  one of formats()
    std::string_view label(std::string_view format) const;
    std::span<const Interpreter* const> interpreters() const { return interpreters_; }
    const PieceReader& pieces() const { return pieces_; }

private:
    struct Known {
        std::string_view name;
        std::string_view label;
        const Interpreter* interpreter;
    };
    const Known* known(std::string_view format) const;
    /// The interpreter that reads the keys of that owner, or null.
    const Interpreter* reader_of(KeyOwner owner) const;

    std::vector<const Interpreter*> interpreters_;
    PieceReader pieces_;
    std::vector<Known> known_;
    std::vector<std::string_view> formats_;
    std::vector<GalleryKey> keys_;
};

/// Normalises a key for comparison: `from_bar` and `from bar` become `from-bar`, and plurals singular.
std::string folded_key(std::string key);

}  // namespace sikku
