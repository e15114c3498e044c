// art/space/daylight.h: the light of sun and sky that reaches a place of a scene.
#pragma once

#include "art/space/casters.h"
#include "art/space/depth_map.h"
#include "art/space/large_array.h"
#include "art/space/lit_places.h"
#include "art/space/scene.h"
#include "art/style/light.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace sikku {

/// Depth maps of a scene, seen from directions spread over the sky and over the disc of the sun. Light from a
/// direction reaches a place if no surface is nearer to the light there. Points and directions are those of the scene
/// (see Scene), y up; the ground is level, at the height of the lowest point of the scene.
///
/// The maps have about the resolution of the picture, those of the sky half of it: for drawings of 512 to 2,048
/// pixels at most 64 of 0.5 MB and 40 of 2 MB, a quarter for smaller and four times as much for larger ones. A sun or
/// a sky that does not shine has no maps.
///
/// Cost: each direction draws all of the scene once, see Casters, for the sky with curved surfaces divided half as
/// finely. It is looked up in 2 ns for each place, if places are lit together that are near each other, so that they
/// look at the same part of the map. Memory: the maps and the casters.
/// Source: many shadow maps for one area light: Segal et al. 1992; sky of an overcast day: Moon and Spencer 1942.
class Daylight {
public:
    /// @param step    millimetres of a turtle step, for widths in millimetres
    /// @param pixels  length of the drawing's longer side in the picture
    Daylight(const Scene& scene, const Style& style, double step, double pixels);
    /// Draws the maps on `threads` threads (0: all cores). Call once, before the queries. @param watch  may be empty;
    /// may throw to stop
    void build(int threads, const std::function<void()>& watch);

    /// Linear light on both sides of a surface, in red, green and blue; 1 or more for one that faces the sun in the
    /// open.
    struct OnSurface {
        glm::vec3 front{0.0F}, behind{0.0F};
    };
    /// The light on both sides of surfaces. The normals are on the side of the eye; what is not thin has no light
    /// behind it. @param places  their light is overwritten @param lights  one for each place
    void on_surfaces(LitPlaces& places, std::vector<OnSurface>& lights) const;
    /// Share of the light of the sky that reaches points of the ground.
    std::vector<float> sky_on_ground(std::span<const glm::vec3> points) const;
    /// Light of the sun on points of the ground.
    std::vector<float> sun_on_ground(std::span<const glm::vec3> points) const;
    /// Light on the ground, as a share of that on open ground, from the results of the two functions above.
    glm::vec3 on_ground(float sky, float sun) const;
    /// Height of the ground: that of the lowest surface.
    float ground() const { return casters_.ground(); }

private:
    bool shines_sky() const { return light_.sun < 1; }
    bool shines_sun() const { return light_.sun > 0; }
    std::vector<DepthMap*> make_heights();
    void find_open_ground();
    void find_shadow(const DepthMap& map);
    int tiles_around() const;
    glm::ivec2 tile_at(const glm::vec2& square) const;
    bool is_tile(int column, int row) const;
    bool may_be_dark(const glm::vec3& point) const;
    /// Light of the sky and of the sun.
    struct Parts {
        float sky = 0, sun = 0;
    };
    void add_sky(LitPlaces& places) const;
    void add_sun(LitPlaces& places) const;
    glm::vec3 mixed(const Parts& parts) const;

    Light light_;
    int side_;  ///< side of the sun's maps, in squares
    Casters casters_;
    std::optional<Casters> coarse_;      ///< for the sky's maps, if there are surfaces that can be simplified
    LargeArray<std::uint16_t> heights_;  ///< of all maps
    std::vector<DepthMap> sky_, sun_;
    std::vector<float> sky_weights_;
    glm::vec3 open_{1.0F};           ///< light on open ground
    float open_sun_ = 1;             ///< light of the sun on open ground
    int columns_ = 0;                ///< number of columns of tiles
    std::vector<char> may_be_dark_;  ///< tiles of the first sun's map that shadows may reach
};

}  // namespace sikku
