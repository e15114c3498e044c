#include "python/kolams.h"

#include "art/kolam/grid_kolam.h"
#include "art/kolam/radial_kolam.h"
#include "art/reading/kolam_fixes.h"
#include "art/reading/kolam_report.h"
#include "engine/base/option.h"
#include "engine/base/text.h"
#include "engine/language/document.h"
#include "python/errors.h"
#include "python/interruption.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace py = pybind11;

namespace sikku {
namespace {

/// Reads the value of an option.
template <class Work>
auto of_option(const char* option, const std::string& value, const Work& work) {
    try {
        return work();
    } catch (const std::runtime_error& error) {
        throw SettingError(option, value, error.what());
    }
}

void check_share(const char* option, double share) {
    if (!(share >= 0 && share <= 1)) refuse_option(option, fmt::format("{}", share), "expected a number from 0 to 1");
}

}  // namespace

py::tuple make_kolam(const std::string& dots, std::uint64_t seed, const std::optional<std::string>& symmetry,
                     std::optional<double> density, double joined, const std::optional<std::string>& crossings,
                     std::uint32_t period, bool is_single_line, int attempts, bool is_coloured, bool draws_dots,
                     bool is_centred, const std::string& rim) {
    if (density) check_share("density", *density);
    check_share("joined", joined);
    if (attempts < 1) refuse_option("attempts", std::to_string(attempts), "expected a whole number from 1");
    if (crossings && (symmetry || density || joined > 0 || period > 0)) {
        refuse_option("crossings", "", "excludes symmetry, density, joined and period");
    }
    const auto [text, facts] = long_call([&](const Monitor& monitor) {
        const DotGrid grid = of_option("grid", dots, [&] { return parse_dot_grid(dots); });
        GridKolamOptions options{.seed = seed,
                                 .density = density,
                                 .joined = joined,
                                 .period = period,
                                 .single_line = is_single_line,
                                 .attempts = attempts};
        if (symmetry) {
            options.symmetry = of_option("symmetry", *symmetry, [&] {
                const GridSymmetry wanted = parse_grid_symmetry(*symmetry);
                require_symmetry(grid, wanted);
                return wanted;
            });
        }
        if (crossings) {
            options.gaps = of_option("crossings", *crossings, [&] { return parse_gap_states(grid, *crossings); });
        }
        if (is_centred && grid.lattice() != DotLattice::square) {
            refuse_option("centred", "", "interlaced dots have no fields between four dots; expected straight rows");
        }
        const RimStyle style = of_option("rim", rim, [&] { return parse_rim_style(rim); });
        const GridKolam made = make_grid_kolam(grid, options, monitor);
        KolamPatternOptions pattern = describe_grid_kolam(grid, options, made);
        if (const std::string title = dot_grid_title(dots); !title.empty()) pattern.title = title;
        pattern.coloured = is_coloured;
        pattern.dot_symbols = draws_dots;
        pattern.centred_dots = is_centred;
        pattern.rim = style;
        pattern.monitor = monitor;
        return std::pair(kolam_pattern(grid, made.states, pattern).text, grid_kolam_json(grid, made));
    });
    return py::make_tuple(to_text(text), to_text(facts));
}

py::str make_radial_kolam(const std::string& size, const std::string& order, bool is_coloured, bool draws_dots) {
    return to_text(long_call([&](const Monitor& monitor) {
        const RadialKolam kolam = of_option("radial", size, [&] { return parse_radial_kolam(size, order); });
        KolamPatternOptions pattern = describe_radial_kolam(kolam);
        pattern.coloured = is_coloured;
        pattern.dot_symbols = draws_dots;
        pattern.monitor = monitor;
        return radial_pattern(kolam, pattern).text;
    }));
}

py::tuple read_kolam(const std::string& path, std::size_t number, const std::string& lattice, const std::string& grid,
                     const std::string& corners, const std::string& crop, bool repairs,
                     const std::vector<std::string>& fixes, double budget) {
    KolamFileOptions options{.number = number, .repair = repairs, .fixes = fixes};
    if (lattice == "square") {
        options.lattice = DotLattice::square;
    } else if (lattice == "interlaced") {
        options.lattice = DotLattice::triangular;
    } else if (!lattice.empty()) {
        refuse_option("lattice", lattice, "expected square or interlaced");
    }
    if (!grid.empty()) options.grid = of_option("grid", grid, [&] { return parse_dot_grid(grid); });
    if (options.grid && options.lattice.value_or(options.grid->lattice()) != options.grid->lattice()) {
        refuse_option("grid", grid, "expected dots of the lattice '" + lattice + "'");
    }
    if (!corners.empty()) {
        options.region = of_option("corners", corners, [&] { return parse_corners(corners); });
    }
    if (!crop.empty()) {
        if (options.region) refuse_option("crop", crop, "excludes corners");
        options.region = of_option("crop", crop, [&] { return parse_crop(crop); });
    }
    const auto [text, facts] = long_call([&](const Monitor& monitor) {
        std::error_code error;
        if (!std::filesystem::exists(path, error)) throw NotFound(path + ": No such file or directory", false);
        const FoundKolam found = [&] {
            try {
                return read_kolam_file(path, path, options, budget, monitor);
            } catch (const NoKolam& refused) {
                throw std::runtime_error(path + ": " + refused.what());
            } catch (const FixError& fix) {
                throw SettingError("fix", fmt::format("{}", fmt::join(fixes, "; ")), fix.what());
            }
        }();
        const KolamReport report = report_kolam(found.kolam, monitor);
        const std::string source = std::filesystem::path(path).filename().string();
        return std::pair(read_kolam_pattern(found.kolam, report, source, monitor),
                         read_kolam_json(found.kolam, report, found.photograph ? &*found.photograph : nullptr));
    });
    return py::make_tuple(to_text(text), to_text(facts));
}

}  // namespace sikku
