//! Each light, shading and space of light.

use super::Cases;
use super::maps::{Tint, flat, full, layers, tinted};
use super::scene::{
    COLOR, DIFFUSE, EXPONENTS, GLOSS, SHINE, Scene, around, bulb, carried, map, point, sun, torch,
};
use super::typed::{InBoth, Picture, Sheet, framed, painted, place};
use alberti::glam::{Vec2, Vec3};
use alberti::shaders::material::{
    BlinnPhong, Color, Directional, Framed, Gloss, Gouraud, Grazing, InSpace, Lambert, Layer, Light,
    Lighting, LinearLight, Material, Phong, PointLight, Reflectance, Specular, Times, Viewer,
};
use alberti::texture::Repeat;
use alberti::{F32, FixedPoint, Lines, NoDerivatives, PerPixel, Rgba8, Vector3};
use alberti_app::draw::{AMBIENT, DIFFUSE as LAMP, to_light};
use alberti_app::options::{self, Arithmetic, KeyLight, LightSpace, Shading};
use alberti_app::scene::{self, Camera, Vertex};

const BARE: (Color<Rgba8>, Specular<Rgba8>) = (Color(DIFFUSE), Specular(SHINE));

/// Layers under lights, in either space.
fn lit<R: Reflectance>(
    scene: &Scene,
    layers: impl Layer<Framed>,
    (ambient, lights): (Vec3, impl Light),
    reflectance: R,
    linear: bool,
) -> Picture {
    let surface =
        Material { layers, lighting: Lighting { viewer: scene.viewer(), ambient, lights, reflectance } };
    if linear {
        painted(scene, &framed, InSpace { surface, space: LinearLight })
    } else {
        painted(scene, &framed, surface)
    }
}

fn blinn() -> Grazing<BlinnPhong<[u32; 2]>> {
    Grazing(BlinnPhong(EXPONENTS))
}

/// All lights.
fn all(linear: bool) -> (Vec3, impl Light) {
    (around(linear), (sun(linear), bulb(linear), torch(linear)))
}

#[test]
fn each_light_is_the_one_of_its_kind() {
    let mut cases = Cases::default();
    let base = Scene::new();
    let ambient = around(false);
    let only = |numbers: &[usize]| {
        let mut scene = base.clone();
        scene.model.lights = numbers.iter().map(|&k| base.model.lights[k]).collect();
        scene
    };
    let mut check = |name: &str, scene: &Scene, expected: Picture| cases.check(name, scene, &expected);
    check("sun", &only(&[0]), lit(&base, BARE, (ambient, sun(false)), blinn(), false));
    check("bulb", &only(&[1]), lit(&base, BARE, (ambient, bulb(false)), blinn(), false));
    check("torch", &only(&[2]), lit(&base, BARE, (ambient, torch(false)), blinn(), false));
    check("ambient", &only(&[]), lit(&base, BARE, (ambient, ()), blinn(), false));
    let lights = (torch(false), sun(false));
    check("torch and sun", &only(&[2, 0]), lit(&base, BARE, (ambient, lights), blinn(), false));
    let mut unmoved = only(&[1]);
    let scene::Light::Point { range, .. } = &mut unmoved.model.lights[0] else { panic!("a bulb") };
    *range = f32::INFINITY;
    let even = PointLight { falloff: [1.0, 0.0, 0.0], ..bulb(false) };
    check("bulb of any range", &unmoved, lit(&base, BARE, (ambient, even), blinn(), false));
    // Lights without an ambient light have the usual one.
    let mut usual = only(&[0, 1, 2]);
    usual.model.ambient = None;
    let (_, lights) = all(false);
    check("lights alone", &usual, lit(&base, BARE, (Vec3::splat(AMBIENT), lights), blinn(), false));
    // In linear light 0.3 is that of a byte.
    let usual = usual.by(|options| options.light.space = LightSpace::Linear);
    let dim = Vec3::splat(alberti::math::srgb::light(AMBIENT.into()) as f32);
    let (_, lights) = all(true);
    check("lights alone, in linear light", &usual, lit(&base, BARE, (dim, lights), blinn(), true));
    cases.done(8);
}

/// All maps but what takes neighbouring pixels.
fn whole(scene: &Scene) -> impl Layer<Framed> {
    layers(|number| scene.map(number), scene.relief(Repeat), scene.lat_long())
}

/// The attributes for light by vertex.
fn shone<'a>(
    scene: &Scene,
    (ambient, lights): (Vec3, impl Light + 'a),
    color: impl Fn(&Vertex) -> Vec3 + 'a,
) -> impl Fn(&Vertex) -> (Vec3, (Vec3, (Vec3, Vec2))) + 'a {
    let lighting = Lighting { viewer: scene.viewer(), ambient, lights, reflectance: blinn() };
    move |v| {
        let normal = Vector3::new(Vec3::from_array(v.normal));
        let [scattered, mirrored] = lighting.at_vertex(point(v.position), normal);
        (place(v), (scattered * color(v), (mirrored, Vec2::from_array(v.uv))))
    }
}

#[test]
fn each_shading_is_that_of_the_library_in_either_space() {
    let mut cases = Cases::default();
    let base = full(Scene::new());
    let map = |number| base.map(number);
    for linear in [false, true] {
        let space = if linear { LightSpace::Linear } else { LightSpace::Srgb };
        let shaded =
            |shading| base.clone().by(|options| (options.shading, options.light.space) = (shading, space));
        let mut check = |shading, expected: Picture| {
            cases.check(&format!("{shading:?} {space:?}"), &shaded(shading), &expected);
        };
        check(Shading::Lambert, lit(&base, whole(&base), all(linear), Lambert, linear));
        check(Shading::Phong, lit(&base, whole(&base), all(linear), Grazing(Phong(EXPONENTS)), linear));
        check(Shading::Blinn, lit(&base, whole(&base), all(linear), blinn(), linear));
        let surface = Gouraud { layers: flat(map) };
        let vertex = shone(&base, all(linear), |_| Vec3::ONE);
        let expected = if linear {
            painted(&base, &vertex, InSpace { surface, space: LinearLight })
        } else {
            painted(&base, &vertex, surface)
        };
        check(Shading::Gouraud, expected);
        // Surfaces without light have no space of it.
        let unlit = lit(&base, whole(&base), (Vec3::ONE, ()), Lambert, false);
        if linear {
            assert!(Picture::of(&shaded(Shading::Unlit)) == unlit);
        } else {
            check(Shading::Unlit, unlit);
        }
    }
    cases.done(9);
}

#[test]
fn fixed_point_has_either_space_and_light_by_vertex() {
    let mut cases = Cases::default();
    let fixed = full(Scene::new()).by(|options| {
        options.policies.interpolation = "spans:8".parse().expect("a name");
        options.policies.arithmetic = Arithmetic::Fixed;
    });
    let (of, by) = (|number| fixed.map(number), FixedPoint(Lines::spans(8).expect("a power of two")));
    let vertex = shone(&fixed, all(false), |_| Vec3::ONE);
    let part = (0, &vertex as &dyn Fn(&Vertex) -> _);
    let gouraud = InBoth(Gouraud { layers: flat(of) });
    let sheet = Sheet::new(&fixed, F32).paint_by::<_, NoDerivatives>(part, &gouraud, by);
    let by_vertex = fixed.clone().by(|options| options.shading = Shading::Gouraud);
    cases.check("by vertex", &by_vertex, &sheet.picture());

    let (ambient, lights) = all(true);
    let lighting =
        Lighting { viewer: fixed.viewer(), ambient, lights, reflectance: Grazing(Phong(EXPONENTS)) };
    let surface = Material { layers: whole(&fixed), lighting };
    let stage = InBoth(InSpace { surface, space: LinearLight });
    let sheet = Sheet::new(&fixed, F32).paint_by::<_, PerPixel>((0, &framed), &stage, by);
    let linear = fixed.clone().by(|options| {
        (options.shading, options.light.space) = (Shading::Phong, LightSpace::Linear);
    });
    cases.check("in linear light", &linear, &sheet.picture());
    cases.done(2);
}

#[test]
fn vertices_colours_multiply_either_light() {
    let mut cases = Cases::default();
    let base = Scene::new().textured().with(|d| (d.colored, d.shininess_map) = (true, map(GLOSS)));
    let skin = Color(Times { factor: DIFFUSE, map: base.map(COLOR) });
    let layers = (skin, Specular(SHINE), Gloss(base.map(GLOSS)));
    for linear in [false, true] {
        let space = if linear { LightSpace::Linear } else { LightSpace::Srgb };
        let shaded =
            |shading| base.clone().by(|options| (options.shading, options.light.space) = (shading, space));
        let vertex = shone(&base, all(linear), |v| carried(v, linear));
        let surface = Gouraud { layers };
        let expected = if linear {
            painted(&base, &vertex, InSpace { surface, space: LinearLight })
        } else {
            painted(&base, &vertex, surface)
        };
        cases.check(&format!("by vertex {space:?}"), &shaded(Shading::Gouraud), &expected);
        let (ambient, lights) = all(linear);
        let reflectance = Grazing(Phong(EXPONENTS));
        let lighting = Lighting { viewer: base.viewer(), ambient, lights, reflectance };
        let surface = Material { layers: (layers, Tint), lighting };
        let vertex = |v: &Vertex| tinted(v, linear);
        let expected = if linear {
            painted(&base, &vertex, InSpace { surface, space: LinearLight })
        } else {
            painted(&base, &vertex, surface)
        };
        cases.check(&format!("by fragment {space:?}"), &shaded(Shading::Phong), &expected);
    }
    let lighting = Lighting { viewer: base.viewer(), ambient: Vec3::ONE, lights: (), reflectance: Lambert };
    let expected = painted(&base, &|v| tinted(v, false), Material { layers: (layers, Tint), lighting });
    cases.check("unlit", &base.clone().by(|options| options.shading = Shading::Unlit), &expected);
    cases.done(5);
}

/// A light beside the camera as strong as in the pictures of models without lights.
fn lamp(camera: &Camera, strength: f32) -> Directional {
    Directional::new(Vector3::new(to_light(camera)), Vec3::splat(strength))
}

/// The studio's lights for a key light in this direction: unit vectors and strengths, beside an ambient light.
pub(super) fn studio(scene: &Scene, [azimuth, elevation]: [f32; 2]) -> (f32, [(Vec3, f32); 3]) {
    let axes = scene.place().axes();
    let up = Vec3::from_array(scene.camera.up).normalize();
    // A camera that looks down has its lights turned to the horizon.
    let ahead = -axes.x_axis.cross(up);
    let towards = |[azimuth, elevation]: [f32; 2]| {
        let ((right, near), (rise, level)) =
            (azimuth.to_radians().sin_cos(), elevation.to_radians().sin_cos());
        (axes.x_axis * (right * level) + up * rise + ahead * (-near * level)).normalize()
    };
    let to_lights = [[azimuth, elevation], [azimuth + 85.0, 5.0], [azimuth + 190.0, 35.0]].map(towards);
    let strengths = [0.7, 0.22, 0.2];
    // The greatest light is not above 1.
    let lengths = (1..8_u32).map(|subset| {
        let chosen = (0..3).filter(|k| subset >> k & 1 != 0);
        chosen.map(|k| to_lights[k] * strengths[k]).sum::<Vec3>().length()
    });
    let share = (0.8 / lengths.fold(0.0, f32::max)).min(1.0);
    (0.2, [0, 1, 2].map(|k| (to_lights[k], strengths[k] * share)))
}

#[test]
fn models_without_lights_have_a_lamp_or_a_studio() {
    let mut cases = Cases::default();
    let base = full(Scene::new()).dark();
    let beside = |linear| if linear { [0.08, 0.92] } else { [AMBIENT, LAMP] };
    for linear in [false, true] {
        let space = if linear { LightSpace::Linear } else { LightSpace::Srgb };
        for shading in [Shading::Lambert, Shading::Blinn] {
            let scene = base.clone().by(|options| (options.shading, options.light.space) = (shading, space));
            let [ambient, strength] = beside(linear);
            let light = (Vec3::splat(ambient), lamp(&base.camera, strength));
            let expected = if shading == Shading::Lambert {
                lit(&base, whole(&base), light, Lambert, linear)
            } else {
                lit(&base, whole(&base), light, blinn(), linear)
            };
            cases.check(&format!("lamp {shading:?} {space:?}"), &scene, &expected);
        }
    }
    let direction = [-35.0, 50.0];
    let scene = base.clone().by(|options| options.light.key = KeyLight::Studio(direction));
    let (ambient, lights) = studio(&base, direction);
    let lights = lights.map(|(to, strength)| Directional::new(Vector3::new(to), Vec3::splat(strength)));
    cases.check("studio", &scene, &lit(&base, whole(&base), (Vec3::splat(ambient), lights), blinn(), false));
    cases.done(5);
}

/// The triangles with vertices of their own, turned around where the eye is behind them.
fn turned(mut scene: Scene) -> Scene {
    let eye = Vec3::from_array(scene.camera.eye);
    let mut vertices = vec![];
    for triangle in &mut scene.model.parts[0].triangles {
        let corners = triangle.map(|index| scene.model.vertices[index as usize]);
        let [a, b, c] = corners.map(|v| place(&v));
        let behind = (b - a).cross(c - a).dot(eye - a) < 0.0;
        let first = vertices.len() as u32;
        vertices.extend(corners.map(|v| {
            let [x, y, z, handedness] = v.tangent;
            let around = Vertex { normal: v.normal.map(|n| -n), tangent: [x, y, z, -handedness], ..v };
            if behind { around } else { v }
        }));
        *triangle = [first, first + 1, first + 2];
    }
    scene.model.vertices = vertices;
    scene
}

#[test]
fn viewers_are_where_the_projection_has_them() {
    let mut cases = Cases::default();
    let mut below = full(Scene::new()).by(|options| options.shading = Shading::Phong);
    below.camera.eye = [0.2, -1.1, 2.6];
    let reflectance = Grazing(Phong(EXPONENTS));
    let seen = lit(&below, whole(&below), all(false), reflectance, false);
    cases.check("from below", &below, &seen);
    let both = below.clone().by(|options| options.light.two_sided = true);
    let around = turned(both.clone());
    let seen = lit(&around, whole(&around), all(false), reflectance, false);
    cases.check("two-sided", &both, &seen);

    let parallel = full(Scene::new()).by(|options| {
        options.projection = options::Projection::Parallel { height: 2.75 };
    });
    let [eye, target] = [parallel.camera.eye, parallel.camera.target].map(Vec3::from_array);
    let (ambient, lights) = all(false);
    let viewer = Viewer::towards(Vector3::new(eye - target));
    let lighting = Lighting { viewer, ambient, lights, reflectance: blinn() };
    let layers = whole(&parallel);
    let Camera { near, far, .. } = parallel.camera;
    let view = alberti::Camera::at(parallel.place()).parallel(2.75, near..far).expect("a view");
    let sheet = Sheet::new(&parallel, F32).paint_through(&framed, Material { layers, lighting }, &view);
    cases.check("parallel", &parallel, &sheet.picture());
    cases.done(3);
}
