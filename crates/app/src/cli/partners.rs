//! Options that mean nothing without others.

use crate::cli::RenderArgs;
use crate::error::{Error, quote};
use crate::load::scene_file;
use crate::options::values::name_of;
use crate::options::{Aov, Base, ColorFormat, Dither, Filter, RenderOptions, Shading};
use crate::scene::{Model, Part, Relief};
use crate::show::Show;

/// An option that does nothing without another is a mistake. Options of maps may be meant for those of a model.
///
/// # Errors
/// There is one.
pub(crate) fn check(arguments: &RenderArgs) -> Result<(), Error> {
    arguments.projector.check()?;
    arguments.camera.check()?;
    if arguments.show.is_some() && arguments.stats.is_some() {
        let error = Error::new("it with --stats, which is of pictures in true colours", "one of the two");
        return Err(error.place("--show"));
    }
    if arguments.render.normals.is_some() && arguments.model.is_none() {
        let error = Error::new("it without a model", "a model, whose normals are made");
        return Err(error.place("--normals").hint("built-in scenes have their own"));
    }
    let camera = &arguments.camera;
    let of_view =
        camera.view_height.filter(|_| !camera.is_parallel()).map(|_| ("view-height", "projection parallel"));
    let of_maps = || arguments.material.lonely().filter(|_| arguments.model.is_none());
    let render = &arguments.render;
    let of_fog = render.fog_color.filter(|_| render.fog.is_none()).map(|_| ("fog-color", "fog"));
    let of_aov = render.aov_format.filter(|_| render.aov.is_none()).map(|_| ("aov-format", "aov"));
    match of_view.or(of_fog).or(of_aov).or_else(of_maps) {
        Some((option, partner)) => {
            let found = format!("it without --{partner}");
            Err(Error::new(found, format!("--{partner} as well")).place(format!("--{option}")))
        }
        None => Ok(()),
    }
}

/// An option of maps that no part of a model has is a mistake as well.
///
/// # Errors
/// There is one.
pub(crate) fn check_maps(arguments: &RenderArgs, model: &Model) -> Result<(), Error> {
    let missing = |base: &Base| !model.parts.iter().any(|part| (base.drawn)(&part.detail));
    match arguments.material.about_maps().find(|(_, base)| missing(base)) {
        Some((option, base)) => {
            let found = format!("a model without {}", base.name);
            let error = Error::new(found, format!("{} for it", base.name)).place(format!("--{option}"));
            Err(error.hint(format!("give one with --{}", base.key)))
        }
        None => Ok(()),
    }
}

/// The warning of a direction of light that nothing is lit from.
pub(crate) fn unused_light(arguments: &RenderArgs, model: &Model) -> Option<Error> {
    arguments.render.light.filter(|_| !model.lights.is_empty() || model.ambient.is_some())?;
    let error = Error::new("it in a scene with lights of its own", "a scene without").place("--light");
    Some(error.hint("the scene's are used"))
}

/// The reason why options change nothing: `found` and `expected`.
type Reason = (String, String);

/// An option, and whether it is given.
type Given = (&'static str, bool);

/// The warnings of options that change nothing in a picture with these, one for each reason. Of options that stand
/// `in_file`, a scene's, there is nothing to say where the command line asks for another picture of it.
pub(crate) fn idle(
    arguments: &RenderArgs,
    model: &Model,
    options: &RenderOptions,
    in_file: &dyn Fn(&str) -> bool,
) -> Vec<Error> {
    let (render, material) = (&arguments.render, &arguments.material);
    let highlights = [
        ("--specular", material.specular.is_some()),
        ("--shininess", material.shininess.is_some()),
        ("--shininess-map", material.shininess_map.is_some()),
    ];
    let bumps = material.height_map.is_some() && material.relief.unwrap_or_default() == Relief::Bump;
    let light = [
        ("--light", render.light.is_some()),
        ("--light-space", render.light_space.is_some()),
        ("--brightness", render.brightness.is_some()),
        ("--two-sided", render.two_sided.is_some()),
        ("--normal-map", material.normal_map.is_some()),
        ("--height-map", bumps),
    ];
    let looks = [
        // A texture makes it white.
        ("--diffuse", material.color.is_some() && material.color_map.is_none()),
        ("--texture", material.color_map.is_some() && arguments.show != Some(Show::Lod)),
        ("--ao", material.ao_map.is_some()),
        ("--wetness-map", material.wetness_map.is_some()),
        ("--environment", material.environment.is_some()),
    ];
    // A scene file's are of textures that it has or may get.
    let alone = !arguments.model.as_deref().is_some_and(scene_file::is_scene);
    let sampled =
        [("--filter", alone && render.filter.is_some()), ("--wrap", alone && render.wrap.is_some())];
    let lod = [("--lod", alone && render.lod.is_some())];
    let around = [("--background", render.background.is_some() && arguments.show != Some(Show::Error))];
    let normals = [("--normals", model.heights.is_empty() && render.normals.is_some())];
    let fog = [("--fog", render.fog.is_some())];
    let dither = [("--dither", render.dither.is_some_and(|dither| dither != Dither::None))];
    let samples = [("--samples", render.samples.is_some())];
    let fog_color = [("--fog-color", render.fog_color.is_some())];
    // Tones and images are of pictures in true colours.
    let tones =
        [("--color", render.color_format.is_some()), ("--projector", arguments.projector.image.is_some())];

    let shading = options.shading;
    let of_shading = |lacks: &str, others: &str| -> Reason {
        (format!("with --shading {}, which is {lacks}", name_of(shading)), format!("{others} for it"))
    };
    let fixed = |found: &str, expected: &str| -> Reason { (found.to_owned(), format!("{expected} for it")) };
    let smaller = |filter| !matches!(filter, Filter::Nearest | Filter::Bilinear);
    let filtered = || model.parts.iter().flat_map(Part::maps).filter_map(|(map, _)| map.filter);
    let one_level = if options.filter == Filter::Nearest { "nearest" } else { "bilinear" };
    let unmapped = model.textures.is_empty() && model.heights.is_empty() && model.slide.is_none();
    let (white, matte) = (shading == Shading::VertexColor, shading == Shading::Lambert);
    let colorless = arguments.show.is_some_and(|show| !matches!(show, Show::Error | Show::Policy));
    // Levels are those of the texture.
    let textures = if arguments.show == Some(Show::Lod) { vec![] } else { [&sampled[..], &lod].concat() };
    let shaded = ("--shading", render.shading.is_some());
    let reasons: [(bool, Given, Vec<Given>, Reason); 9] = [
        (
            colorless,
            ("--show", true),
            [&fog[..], &fog_color, &tones, &light, &normals, &highlights, &looks, &textures].concat(),
            fixed("with --show of a number that is none of colours", "a picture in true colours"),
        ),
        (
            arguments.show.is_some(),
            ("--show", true),
            [&samples[..], &around].concat(),
            fixed(
                "with --show, which has one sample a pixel of the model alone",
                "a picture in true colours",
            ),
        ),
        (white, shaded, [&looks[..], &sampled].concat(), of_shading("of the vertices alone", "another")),
        (
            !shading.is_lit(),
            shaded,
            [&light[..], &normals, &highlights].concat(),
            of_shading("without light", "lambert, phong or blinn"),
        ),
        (
            options.haze.is_none(),
            // In a file the colour waits for a fog.
            ("", true),
            fog_color.to_vec(),
            fixed("with --fog none", "a fog"),
        ),
        (matte, shaded, highlights.to_vec(), of_shading("without highlights", "phong or blinn")),
        (
            unmapped,
            ("", false),
            [&sampled[..], &lod].concat(),
            fixed("on a model without textures", "one that has some"),
        ),
        (
            !smaller(options.filter) && !filtered().any(smaller),
            ("--filter", render.filter.is_some()),
            lod.to_vec(),
            fixed(&format!("with --filter {one_level}, which has one level"), "trilinear or anisotropic"),
        ),
        (
            options.policies.color == ColorFormat::Rgba8,
            ("--color", render.color_format.is_some()),
            dither.to_vec(),
            fixed(
                "with --color rgba8, whose steps are those of the picture",
                "fewer bits, such as --color rgb565,",
            ),
        ),
    ];
    let mut told: Vec<&str> = Vec::new();
    let mut warnings = Vec::new();
    for (_, (by, on_line), options, (found, expected)) in reasons.into_iter().filter(|(holds, ..)| *holds) {
        let asked = on_line && !in_file(by);
        let given = options.into_iter().filter(|(option, given)| *given && !told.contains(option));
        let given = given.filter(|(option, _)| !(asked && in_file(option)));
        let given: Vec<&'static str> = given.map(|(option, _)| option).collect();
        let [first, others @ ..] = given.as_slice() else { continue };
        let them = if others.is_empty() { "it".to_owned() } else { format!("it and {}", others.join(", ")) };
        let warning = Error::new(format!("{them} {found}"), expected).place(*first);
        warnings.push(warning.hint("nothing changes"));
        told.extend(given);
    }
    warnings
}

/// The warnings of numbers beside the picture that are the same everywhere.
pub(crate) fn empty_layers(arguments: &RenderArgs, model: &Model) -> Vec<Error> {
    let asked = |aov| arguments.render.aov.as_ref().is_some_and(|aovs| aovs.has(aov));
    let has_uv = model.vertices.iter().any(|vertex| vertex.uv != [0.0; 2]);
    let untextured = model.parts.iter().all(|part| part.texture.is_none());
    let layers = [
        (Aov::Uv, !has_uv, "a model without texture coordinates"),
        (Aov::Lod, untextured, "a model without a texture"),
    ];
    let empty = layers.into_iter().filter(|(aov, empty, _)| *empty && asked(*aov));
    let warning = |(aov, _, found): (_, _, &str)| {
        let error = Error::new(format!("{} of {found}", name_of(aov)), "a model with some").place("--aov");
        error.hint("it is 0 everywhere")
    };
    empty.map(warning).collect()
}

/// The warning of colours of vertices that are asked for and not there, or there and not shown.
pub(crate) fn unseen_colors(model: &Model, shading: Shading) -> Option<Error> {
    let white = model.vertices.iter().all(|vertex| vertex.color == [1.0; 3]);
    if shading == Shading::VertexColor && white {
        let found = "a model whose vertices have no colours";
        let error = Error::new(found, "some, as in `v x y z r g b`").place("--shading");
        return Some(error.hint("all of it is white"));
    }
    let lost = |part: &Part| part.detail.colored && part.detail.needs_tangents();
    if shading == Shading::VertexColor || !model.parts.iter().any(lost) {
        return None;
    }
    let found = "colours of vertices on a surface with normals or heights of a map";
    let error = Error::new(found, "one of both").hint("the colours of vertices are left out");
    Some(match &model.source {
        Some(path) => error.file(path),
        None => error.place("--shading"),
    })
}

/// The warning of heights that are not used, as a surface's normals are those of its normal map.
pub(crate) fn unused_heights(model: &Model) -> Option<Error> {
    let unused = |part: &&Part| {
        let bump = part.detail.height.is_some_and(|height| height.relief == Relief::Bump);
        bump && part.detail.normal.is_some()
    };
    let part = model.parts.iter().find(unused)?;
    let of =
        if part.name.is_empty() { String::new() } else { format!(" of {}", quote(part.name.as_bytes())) };
    let found = format!("a normal map and heights for bumps on the surface{of}");
    let warning = Error::new(found, "one of both, or another relief").hint("the heights are left out");
    Some(match &model.source {
        Some(path) => warning.file(path),
        None => warning.place("--height-map"),
    })
}
