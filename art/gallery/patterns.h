// art/gallery/patterns.h: finds patterns by name, file, folder or wildcards, and reads each once.
#pragma once

#include "engine/base/monitor.h"
#include "engine/interpreter.h"
#include "engine/language/document.h"

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// The text of a pattern and its name in messages.
struct PatternText {
    std::string name;
    std::string text;
};

/// A file that plays several patterns as one piece: an arrangement.
struct GalleryPiece {
    std::string title;
    std::string source;
    std::string text;                 ///< including every pattern
    std::vector<Document> documents;  ///< documents of its parts; at least one
    /// Plans a work. `folder` contains the files that `values` name. Thread-safe. @throws as Interpreter::plan()
    std::function<std::unique_ptr<Work>(std::string_view format, const OptionValues& values,
                                        const std::filesystem::path& folder)>
        plan;
};

/// Reads pieces for galleries. This library does not contain music, so its caller supplies a reader.
struct PieceReader {
    const Interpreter* interpreter = nullptr;  ///< makes their files; null: pieces are not supported
    /// Reads a file, given with its name in messages. @throws std::runtime_error with the place of the error
    std::function<GalleryPiece(const std::filesystem::path& file, const std::string& name)> read{};
};

/// A pattern or a piece of a gallery, read once.
struct GalleryPattern {
    std::string name;                         ///< name without folder and extension
    std::string kind;                         ///< folder that contains it
    std::string path;                         ///< path for reading it, and for finding files beside it
    std::string shown;                        ///< name in manifests
    std::shared_ptr<const PatternText> text;  ///< null if it cannot be read
    std::string problem;                      ///< reason if it cannot be read
    bool is_piece = false;
    std::shared_ptr<const GalleryPiece> piece;  ///< null for patterns, and if it cannot be read
};

/// True if the whole of `name` matches `form`, in which `*` stands for any bytes, `?` for one, `[a-z]` and `[!a-z]`
/// for one byte in or not in a set, and `\` quotes the next byte. Time: at most the product of both lengths.
bool fits_wildcards(std::string_view form, std::string_view name);

/// Finds patterns and reads each once. Searches at most a million folder entries and reads at most 1 GB.
class PatternShelf {
public:
    using Pointer = std::shared_ptr<const GalleryPattern>;
    using List = std::shared_ptr<const std::vector<Pointer>>;

    /// @param bundled_only  search only the bundled patterns
    explicit PatternShelf(bool bundled_only, PieceReader pieces = {}, Monitor monitor = {})
        : bundled_only_(bundled_only), pieces_(std::move(pieces)), monitor_(monitor) {}

    /// @throws GalleryError, or NotFound without a place, if none is found; GalleryError if there are too many
    /// entries to search; Stopped
    List find(const std::string& word, const std::filesystem::path& folder, const std::string& place);
    /// All bundled patterns that draw something.
    List all();

private:
    std::vector<Pointer> find_files(const std::string& word, const std::filesystem::path& folder,
                                    const std::string& place, bool& is_folder);
    static const std::vector<LibraryPattern>& known() { return PatternLibrary::bundled().patterns(); }
    Pointer of_known(const LibraryPattern& known) { return read(known.file, known.name, known.name + ".lsys"); }
    Pointer of_file(const std::filesystem::path& file) { return read(file, file.string(), file.string()); }
    Pointer read(const std::filesystem::path& file, const std::string& shown, const std::string& called);

    /// Adds the bundled arrangement of that name, or all of them for the name of their folder.
    void find_bundled_pieces(const std::string& word, std::vector<Pointer>& found);
    bool is_piece(const std::filesystem::path& file) const;

    bool bundled_only_;
    PieceReader pieces_;
    Monitor monitor_;
    std::map<std::string, Pointer> read_;
    std::map<std::pair<std::filesystem::path, std::string>, List> found_;
    std::size_t bytes_ = 0;    // size of all texts
    std::size_t entries_ = 0;  // folder entries searched so far
};

}  // namespace sikku
