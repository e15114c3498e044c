#include "python/collections.h"

#include "art/gallery/gallery.h"
#include "art/prints.h"
#include "engine/base/diagnostic.h"
#include "engine/base/input_file.h"
#include "engine/base/memory.h"
#include "engine/base/text.h"
#include "engine/base/toml_file.h"
#include "engine/language/arrangement_library.h"
#include "music/scores.h"
#include "python/errors.h"
#include "python/interruption.h"

#include <set>
#include <string>
#include <utility>

namespace py = pybind11;

namespace sikku {
namespace {

/// Galleries of patterns; those of arrangements need the program.
const GalleryKeys& gallery_keys() {
    static const GalleryKeys keys({&prints(), &scores()});
    return keys;
}

/// Counts finished jobs as progress.
class Listener final : public GalleryListener {
public:
    explicit Listener(const Monitor& monitor) : monitor_(monitor) {}
    void begin(std::size_t jobs, double /*cost*/) override { monitor_.expect(static_cast<double>(jobs)); }
    void finish(double /*cost*/) override {
        try {
            monitor_.advance(1);
        } catch (const Stopped&) {
            // The gallery notices it by itself.
        }
    }

private:
    const Monitor& monitor_;
};

py::list to_texts(const std::vector<std::string>& texts) {
    py::list list;
    for (const std::string& text : texts) list.append(to_text(text));
    return list;
}

}  // namespace

LoadedArrangement load_arrangement(const std::string& name, const std::optional<std::string>& text,
                                   const std::optional<std::string>& given_folder) {
    return long_call([&](const Monitor& monitor) {
        std::filesystem::path path = name;
        std::error_code error;
        if (!text && !std::filesystem::exists(path, error)) {
            const auto bundled = bundled_arrangement(name);
            if (!bundled) {
                const std::vector<std::string> names = bundled_arrangements();
                const std::string_view near = nearest(name, {names.begin(), names.end()});
                throw NotFound("no file or arrangement named '" + name + "'" + did_you_mean(near), !near.empty());
            }
            path = *bundled;
        }
        const std::filesystem::path folder = given_folder ? std::filesystem::path(*given_folder) : path.parent_path();
        const auto read = [&](const std::string& pattern) {
            const PatternFile found = find_pattern(pattern);
            return NamedPattern{found.name, read_pattern({pattern, found.path}, monitor)};
        };
        return LoadedArrangement{
            read_arrangement(name, text ? *text : read_file(path, name, most_toml_bytes, monitor),
                             beside_first(folder, read)),
            folder};
    });
}

py::tuple make_piece(const LoadedArrangement& piece, const std::string& format, const TextPairs& values,
                     const py::object& progress) {
    MemoryDestination memory;
    const auto make = [&](const Monitor& monitor) {
        return plan_score(piece.arrangement, format, to_values(values), piece.folder)
            ->make(memory, "memory." + format, monitor);
    };
    const Made made = long_call(make, progress);
    return py::make_tuple(to_dict(memory, find_format(scores().formats(), format)), to_list(made.remarks));
}

py::list write_piece(const LoadedArrangement& piece, const std::string& format, const TextPairs& values,
                     const std::string& path, const py::object& progress) {
    const auto make = [&](const Monitor& monitor) {
        return plan_score(piece.arrangement, format, to_values(values), piece.folder)
            ->make(file_system(), path, monitor);
    };
    return to_list(long_call(make, progress).remarks);
}

py::tuple notes_of_piece(const LoadedArrangement& piece, const TextPairs& values) {
    return to_tuple(
        long_call([&](const Monitor& monitor) { return list_notes(piece.arrangement, to_values(values), monitor); }));
}

py::tuple make_gallery(const GalleryCall& call, const py::object& progress) {
    struct MadeGallery {
        std::vector<GalleryJob> jobs;
        GalleryResult result;
    };
    const auto make = [&](const Monitor& monitor) {
        GalleryRequest request;
        request.patterns = call.patterns;
        request.gallery_file = call.file.empty() ? "" : PatternLibrary::bundled().gallery_file(call.file);
        request.keys = call.keys;
        request.poster = call.poster;
        request.contact = call.contact;
        request.monitor = monitor;
        const double memory = call.memory > 0 ? call.memory : static_cast<double>(available_memory()) / 2;
        Gallery gallery(std::move(request),
                        {.folder = call.folder,
                         .force = call.force,
                         .keep_going = call.keep_going,
                         .memory = memory,
                         .threads = call.threads},
                        gallery_keys(), monitor);
        Listener listener(monitor);
        GalleryResult result = gallery.make(listener);
        monitor.check();
        return MadeGallery{gallery.jobs(), std::move(result)};
    };
    const auto [jobs, result] = long_call(make, progress);
    const std::set<std::size_t> made(result.made.begin(), result.made.end());
    py::list finished, failures;
    for (const auto& [job, file] : result.finished) {
        finished.append(py::make_tuple(to_text(file.file), file.bytes, made.contains(job), to_texts(file.warnings)));
    }
    for (const Failure& failure : result.failures) {
        failures.append(py::make_tuple(to_text(jobs[failure.job].file()), to_text(failure.message)));
    }
    return py::make_tuple(finished, failures, to_texts(result.warnings), to_texts(result.troubles));
}

}  // namespace sikku
