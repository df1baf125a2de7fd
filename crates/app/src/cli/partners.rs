//! Options that mean nothing without others.

use crate::cli::RenderArgs;
use crate::error::{Error, quote};
use crate::options::values::name_of;
use crate::options::{Base, ColorFormat, Dither, Filter, RenderOptions, Shading};
use crate::scene::{Model, Part, Relief};

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

/// The warnings of options that change nothing in a picture with these, one for each reason.
pub(crate) fn idle(arguments: &RenderArgs, model: &Model, options: &RenderOptions) -> Vec<Error> {
    let (render, material) = (&arguments.render, &arguments.material);
    let highlights = [
        ("--specular", material.specular.is_some()),
        ("--shininess", material.shininess.is_some()),
        ("--shininess-map", material.shininess_map.is_some()),
    ];
    let light = [
        ("--light", render.light.is_some()),
        ("--light-space", render.light_space.is_some()),
        ("--two-sided", render.two_sided.is_some()),
        ("--normal-map", material.normal_map.is_some()),
    ];
    let smaller = |filter| !matches!(filter, Filter::Nearest | Filter::Bilinear);
    let mapped = || model.parts.iter().flat_map(Part::maps).filter_map(|(map, _)| map.filter);
    let shading = options.shading;
    let (lit, matte) = (shading.is_lit(), shading == Shading::Lambert);
    let reasons = [
        (!lit, [&light[..], &highlights].concat(), "without light", "lambert, phong or blinn"),
        (lit && matte, highlights.to_vec(), "without highlights", "phong or blinn"),
    ];
    let of_shading = reasons.into_iter().filter(|(holds, ..)| *holds).map(|(_, idle, lacks, others)| {
        (idle, format!("with --shading {}, which is {lacks}", name_of(shading)), format!("{others} for it"))
    });
    let filter = if options.filter == Filter::Nearest { "nearest" } else { "bilinear" };
    let of_filter = Some((
        vec![("--lod", render.lod.is_some())],
        format!("with --filter {filter}, which has one level"),
        "trilinear or anisotropic for it".to_owned(),
    ));
    let of_filter = of_filter.filter(|_| !smaller(options.filter) && !mapped().any(smaller));
    let of_color = Some((
        vec![("--dither", render.dither.is_some_and(|dither| dither != Dither::None))],
        "with --color rgba8, whose steps are those of the picture".to_owned(),
        "fewer bits, such as --color rgb565, for it".to_owned(),
    ));
    let of_color = of_color.filter(|_| options.policies.color == ColorFormat::Rgba8);
    let of_show = Some((
        vec![("--samples", render.samples.is_some())],
        "with --show, which has one sample a pixel".to_owned(),
        "a picture in true colours for it".to_owned(),
    ));
    let of_show = of_show.filter(|_| arguments.show.is_some());
    let warning = |(options, found, expected): (Vec<(&'static str, bool)>, String, String)| {
        let mut given = options.into_iter().filter(|(_, given)| *given).map(|(option, _)| option);
        let first = given.next()?;
        let others: Vec<&str> = given.collect();
        let them = if others.is_empty() { "it".to_owned() } else { format!("it and {}", others.join(", ")) };
        Some(Error::new(format!("{them} {found}"), expected).place(first).hint("nothing changes"))
    };
    of_shading.chain(of_filter).chain(of_color).chain(of_show).filter_map(warning).collect()
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
