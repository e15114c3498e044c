#include "art/relief/relief_files.h"

#include "engine/base/bits.h"
#include "engine/base/chance.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <string>
#include <unordered_map>
#include <vector>

namespace sikku {
namespace {

glm::vec3 millimetres(const SolidPoint& point) {
    return glm::vec3(glm::dvec3(point.x, point.y, point.z) / 1000.0);
}

struct PointHash {
    std::size_t operator()(const SolidPoint& point) const {
        const auto bits = [](std::int32_t value) { return std::uint64_t{static_cast<std::uint32_t>(value)}; };
        return static_cast<std::size_t>(scrambled(scrambled(bits(point.x) << 32 | bits(point.y)) ^ bits(point.z)));
    }
};

/// Binary STL: 3D Systems 1989; Burns 1993, "Automated Fabrication", section 6.5.
class StlFile {
public:
    StlFile(Output& output, std::size_t triangles) : output_(output) {
        constexpr std::size_t head = 80;
        std::string title = std::string(stl_title) + SIKKU_VERSION;
        title.resize(head, ' ');
        output_.write(title);
        put(static_cast<std::uint32_t>(triangles));
    }
    void add(const SolidTriangle& triangle) {
        const std::array<glm::vec3, 3> corners = {millimetres(triangle[0]), millimetres(triangle[1]),
                                                  millimetres(triangle[2])};
        // The normal is computed from the corners as written.
        const auto written = [&](std::size_t corner) {
            const glm::vec3& at = corners[corner];
            return glm::dvec3(widened(at.x), widened(at.y), widened(at.z));
        };
        const glm::dvec3 across = glm::cross(written(1) - written(0), written(2) - written(0));
        const double length = glm::length(across);
        put(glm::vec3(length > 0 ? across / length : glm::dvec3(0.0)));
        for (const glm::vec3& corner : corners) put(corner);
        buffer_.append(2, '\0');
        constexpr std::size_t block = 1 << 16;
        if (buffer_.size() >= block) flush();
    }
    void flush() {
        output_.write(buffer_);
        buffer_.clear();
    }

private:
    void put(std::uint32_t number) {
        for (int shift = 0; shift < 32; shift += 8) buffer_ += static_cast<char>(number >> shift & 0xff);
    }
    void put(const glm::vec3& point) {
        for (const float value : {point.x, point.y, point.z}) put(bit_cast<std::uint32_t>(value));
    }

    Output& output_;
    std::string buffer_;
};

ModelReport write_stl(const Solid& solid, const std::filesystem::path& file, Destination& destination) {
    ModelReport report;
    solid.visit([&](std::uint32_t, const SolidTriangle&) { ++report.triangles; });
    const auto output = destination.open(file);
    StlFile stl(*output, report.triangles);
    solid.visit([&](std::uint32_t, const SolidTriangle& triangle) { stl.add(triangle); });
    stl.flush();
    output->commit();
    return report;
}

/// A mesh for each colour; the first one has the corners of all.
std::vector<Mesh> meshes_of(const Solid& solid) {
    std::vector<Mesh> meshes;
    std::vector<std::size_t> mesh_of;
    for (const ReliefRegion& region : solid.regions()) {
        const auto known = std::find_if(meshes.begin(), meshes.end(),
                                        [&](const Mesh& mesh) { return mesh.colour == region.colour; });
        mesh_of.push_back(static_cast<std::size_t>(known - meshes.begin()));
        if (known == meshes.end()) meshes.push_back({.colour = region.colour, .kind = "relief"});
    }
    std::unordered_map<SolidPoint, std::uint32_t, PointHash> numbers;
    std::vector<glm::vec3> positions;
    solid.visit([&](std::uint32_t region, const SolidTriangle& triangle) {
        for (const SolidPoint& point : triangle) {
            const auto [known, is_new] = numbers.emplace(point, static_cast<std::uint32_t>(positions.size()));
            if (is_new) positions.push_back(millimetres(point));
            meshes[mesh_of[region]].corners.push_back(known->second);
        }
    });
    std::erase_if(meshes, [](const Mesh& mesh) { return mesh.corners.empty(); });
    if (!meshes.empty()) meshes.front().positions = std::move(positions);
    return meshes;
}

}  // namespace

ModelReport write_solid(const Solid& solid, const Print& print, PrintFormat format, const std::filesystem::path& file,
                        const Monitor& monitor, Destination& destination) {
    if (format == PrintFormat::stl) return write_stl(solid, file, destination);
    return write_meshes(meshes_of(solid), {.is_solid = true}, print, format, file, monitor, destination);
}

}  // namespace sikku
