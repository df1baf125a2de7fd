//! Plain surfaces: a colour, or a texture that is read in its largest level, as it is or in a light from beside the
//! camera.
//!
//! They have kernels of their own for the registers that nearly all machines have. Where an x86-64 processor has no
//! AVX2, as before 2013, they are drawn like any surface: the pixels are the same, and fifteen kernels less are built.

use super::maps::{FlatMap, Scaled, TileMap, flat_map, tile_map};
use super::studio::Lamplit;
use super::used::Used;
use super::{Canvas, Drawing, color, memory, position};
use crate::options::{Interpolation, Shading};
use crate::scene::{Part, Vertex};
use alberti::glam::{Vec2, Vec3};
use alberti::lanes::Machine;
use alberti::shaders::{Unlit, VertexColor};
use alberti::{FragmentStage, Mesh, Planes, Rgba8, Slot, Varying};

/// A colour, or a texture times that colour.
pub(super) type Skin<'a> = Scaled<FlatMap<'a>>;

/// The lanes that plain surfaces have kernels for.
macro_rules! for_plain_lanes {
    ($machine:expr, $lanes:ident => $body:expr) => {{
        #[cfg(target_arch = "x86_64")]
        if let Machine::Avx2($lanes) = $machine {
            $body
        }
        #[cfg(not(target_arch = "x86_64"))]
        alberti::for_lanes!($machine, $lanes => $body);
    }};
}

/// Whether this machine has such lanes.
pub(super) fn has_kernels() -> bool {
    Machine::all().next().is_some_and(has_plain_lanes)
}

#[cfg(target_arch = "x86_64")]
fn has_plain_lanes(machine: Machine) -> bool {
    matches!(machine, Machine::Avx2(_))
}

#[cfg(not(target_arch = "x86_64"))]
fn has_plain_lanes(_: Machine) -> bool {
    true
}

impl<'a> Drawing<'a> {
    /// The skin of a part.
    pub(super) fn skin(&self, part: &Part) -> Skin<'a> {
        let texture = part.texture.and_then(|t| self.textures.get(t));
        let map = texture.map(|texture| flat_map(*texture, self.options));
        Scaled { factor: color(part.diffuse), map }
    }

    /// The skin, if it is a texture for the shortest way.
    fn tiles(&self, part: &Part) -> Option<TileMap<'a>> {
        let texture = self.textures.get(part.texture?)?;
        tile_map(*texture, self.options).filter(|_| color(part.diffuse) == Rgba8::WHITE)
    }

    /// A map in the light of a model without lights.
    pub(super) fn lit<M: Copy>(&self, map: M) -> Lamplit<M> {
        Lamplit::new(map, self.rig)
    }

    /// A plain surface in floats.
    pub(super) fn draw_plain(&mut self, part: &Part, triangles: &[[u32; 3]], target: &mut Canvas<'_>) {
        let normal = |v: &Vertex| Vec3::from_array(v.normal);
        let uv = |v: &Vertex| Vec2::from_array(v.uv);
        let normal_uv = |v: &Vertex| (normal(v), uv(v));
        match (self.options.shading, self.tiles(part)) {
            (Shading::VertexColor, _) => {
                self.draw(triangles, |v| Vec3::from_array(v.color), VertexColor, target);
            }
            (Shading::Unlit, Some(map)) => self.draw(triangles, uv, Unlit(map), target),
            (Shading::Unlit, None) => self.draw(triangles, uv, Unlit(self.skin(part)), target),
            (_, Some(map)) => self.draw(triangles, normal_uv, self.lit(map), target),
            (_, None) => self.draw(triangles, normal_uv, self.lit(self.skin(part)), target),
        }
    }

    fn draw<V: Varying>(
        &mut self,
        triangles: &[[u32; 3]],
        varying: impl Fn(&Vertex) -> V + Sync,
        stage: impl FragmentStage<V, Color = Rgba8> + Sync,
        target: &mut Canvas<'_>,
    ) where
        Slot<V>: Send + Sync,
    {
        let Used { vertices, triangles } = self.sided(triangles);
        let mesh = Mesh::new(&vertices, &triangles, |v: &Vertex| (position(v), varying(v)));
        let (mut room, mut slots) = memory(&mesh);
        let Some(machine) = Machine::all().next() else { return };
        let (mut stats, threads, lines) = (self.stats, self.options.threads, self.lines());
        for_plain_lanes!(machine, lanes => {
            let mut pass = self.pass(&mesh, stage, &mut slots);
            let (room, stats) = (&mut room, &mut stats);
            match (self.options.policies.interpolation, lines) {
                (_, Some(lines)) => {
                    pass.interpolation(lines).count_by_threads(lanes, threads, room, target, stats);
                }
                (Interpolation::Plane, None) => {
                    pass.interpolation(Planes).count_by_threads(lanes, threads, room, target, stats);
                }
                (_, None) => pass.count_by_threads(lanes, threads, room, target, stats),
            }
        });
        self.stats = stats;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::Studio;
    use crate::options::{DepthFormat, Filter, LightOptions, Policies, RenderOptions};
    use crate::render::any_depth;
    use crate::scene::scenes;
    use alberti::{DepthFormat as _, Rgba8888, Target};
    use std::num::NonZero;

    /// The picture of the one kernel is that of the kernels of its own, by every interpolation.
    #[test]
    fn plain_surfaces_are_drawn_alike_by_either_kernel() {
        for (name, shading) in
            [("cube", Shading::VertexColor), ("floor", Shading::Unlit), ("floor", Shading::Lambert)]
        {
            let scene = scenes::by_name(name).expect("a scene");
            for interpolation in ["exact", "plane", "spans:8", "bounded:0.25", "affine"] {
                let options = RenderOptions {
                    width: 160,
                    height: 120,
                    background: scene.background,
                    shading,
                    filter: Filter::Nearest,
                    wrap: scene.wrap,
                    cull: scene.cull,
                    depth: DepthFormat::F32,
                    projection: crate::options::Projection::Perspective,
                    haze: None,
                    light: LightOptions::default(),
                    threads: NonZero::<usize>::MIN,
                    policies: Policies {
                        interpolation: interpolation.parse().expect("a name"),
                        ..Policies::default()
                    },
                };
                let studio = Studio::new(&scene.model, &scene.camera, &options).expect("a studio");
                let drawn = |plain: bool| {
                    let mut drawing =
                        Drawing::new(&scene.model, &scene.camera, &options, &studio).expect("a drawing");
                    let format = any_depth(options.depth);
                    let (mut color, mut depth) = (vec![0; 160 * 120], vec![format.farthest(); 160 * 120]);
                    let target = Target::new(Rgba8888, format, 160, 120, &mut color, &mut depth);
                    let mut target = target.expect("buffers that fit");
                    for part in &scene.model.parts {
                        if plain && has_kernels() {
                            drawing.draw_plain(part, &part.triangles, &mut target);
                        } else {
                            drawing.draw_general(part, &part.triangles, &mut target);
                        }
                    }
                    color
                };
                let found = drawn(true);
                assert!(found == drawn(false), "{name} {shading:?} {interpolation}");
                assert!(found.iter().any(|&pixel| pixel != 0));
            }
        }
    }
}
