// engine/base/toml_file.h: reads TOML files of users as plain values with places.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sikku {

/// Line and column in a file, from 1.
using LineAndColumn = std::pair<std::uint32_t, std::uint32_t>;

/// A value with its place.
struct FileValue {
    enum class Type { text, list, table, other };
    Type type = Type::text;
    std::string text;  ///< numbers and flags too
    std::vector<FileValue> list;
    struct Entry;
    std::vector<Entry> table;  ///< in the order of the file; the place of a value is its key's
    std::string place;         ///< `gallery.toml:3:1`
    LineAndColumn order{0, 0};
};
struct FileValue::Entry {
    std::string key;
    FileValue value;
};

/// Maximum size of a TOML file in bytes.
constexpr std::size_t most_toml_bytes = std::size_t{16} << 20;
/// Maximum number of keys in a table.
constexpr std::size_t most_table_keys = 1000;

/// An error in a file of settings, or in what was requested; what() begins with the place if there is one.
class FileError : public std::runtime_error {
public:
    static constexpr LineAndColumn no_line{std::numeric_limits<std::uint32_t>::max(), 0};  ///< after all lines

    explicit FileError(const std::string& text, LineAndColumn order = no_line)
        : std::runtime_error(text), order_(order) {}
    /// Place in the file, for errors of one value.
    LineAndColumn order() const { return order_; }

private:
    LineAndColumn order_;
};

/// @param place  may be empty
/// @throws FileError always
[[noreturn]] void fail(const std::string& place, const std::string& message);
/// The same with the place of a value.
[[noreturn]] void fail(const FileValue& value, const std::string& message);

/// Reads a TOML file. Nesting and values are counted before it is parsed. Time: linear; memory: about 300 bytes
/// per value.
/// @param file  its name, for places
/// @throws FileError for errors, over 16 MB, 250,000 values, 1,000 keys in a table, and nesting deeper than 50
FileValue read_toml(const std::string& file, const std::string& text);

}  // namespace sikku
