// art/gallery/items.h: reads gallery files, manifests and command lines into items: lists of patterns, formats, and
// keys with all their values, not yet expanded.
#pragma once

#include "art/gallery/jobs.h"
#include "art/gallery/keys.h"
#include "art/gallery/values.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// A range such as `60:90:5`, not expanded.
struct GalleryRange {
    double first = 0;
    double step = 1;
    double count = 1;  ///< may be infinite

    std::string value(std::uint64_t index) const;
};

/// A key and all its values. Ranges are stored unexpanded, so memory is linear in the file.
class GalleryAxis {
public:
    GalleryAxis(std::string its_key, std::string its_place, bool is_in_set)
        : key(std::move(its_key)), place(std::move(its_place)), in_set(is_in_set) {}

    void add(std::string text) { add({std::move(text), std::nullopt, count_}, 1); }
    void add(const GalleryRange& range) { add({{}, range, count_}, range.count); }

    double count() const { return count_; }
    std::string value(std::uint64_t index) const;
    /// True for a single value, and for the first or last of a range.
    bool is_end(std::uint64_t index) const;

    std::string key;
    std::string place;
    bool in_set;

private:
    struct Part {
        std::string text;
        std::optional<GalleryRange> range;  ///< instead of the text
        double begin = 0;                   ///< index of its first value
    };
    void add(Part part, double count) {
        parts_.push_back(std::move(part));
        count_ += count;
    }
    const Part& part_of(std::uint64_t index) const;
    std::vector<Part> parts_;
    double count_ = 0;
};

/// Settings requested together. Copies share the values.
struct GalleryItem {
    using Axis = std::shared_ptr<const GalleryAxis>;
    std::string place;
    bool needs_pattern = false;
    std::filesystem::path folder;
    std::shared_ptr<const std::vector<std::string>> patterns;  ///< null: the bundled patterns
    std::string patterns_place;
    std::vector<std::string> formats;
    std::shared_ptr<const std::string> name;  ///< with placeholders; null: the default form
    std::string name_place;
    std::vector<Axis> axes;

    /// Replaces an axis of the same key.
    void take(Axis axis);
};

/// A list of items that limits their number: each makes at least one job.
class GalleryItems {
public:
    /// @throws GalleryError if there are too many items, or too many settings in all of them
    void add(GalleryItem item);
    std::vector<GalleryItem> list;

private:
    std::size_t settings_ = 0;
};

/// Maximum length of a name or a name template; longer ones are rejected.
constexpr std::size_t longest_job_name = 1000;

/// Sets a key of an item to the value in a file. @throws GalleryError
void read_gallery_key(const GalleryKeys& keys, const std::string& written, const GalleryValue& value,
                      GalleryItem& item);
/// Reads the axis of a key. @throws GalleryError
/// @param known  the row of the key; null for keys and defines of the pattern
GalleryAxis axis_of(const std::string& key, const GalleryValue& value, const GalleryKey* known);

/// @throws GalleryError if the value is not a sheet size
void check_sheet_size(const std::string& key, const std::string& size, const std::string& place);

/// Reads a gallery file: defaults into `defaults`; title and sizes of sheets into `request`, unless it contains them.
void read_gallery(const GalleryKeys& keys, const std::string& file, const std::string& text, GalleryItem& defaults,
                  GalleryRequest& request, GalleryItems& items);
/// Reads a manifest, line by line.
void read_manifest(const GalleryRequest& request, const GalleryKeys& keys, std::istream& stream,
                   const GalleryItem& defaults, GalleryItems& items);

}  // namespace sikku
