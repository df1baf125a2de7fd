//! Objects of a scene file: their meshes, their materials, and where they stand.

use std::ops::Range;

use super::SceneFile;
use super::tables::{self, SurfaceKind};
use crate::error::{Error, Warnings, quote};
use crate::load::images::Images;
use crate::load::material::Material;
use crate::load::{obj, prepare};
use crate::options::Wrap;
use crate::scene::displace::MAX_VERTICES;
use crate::scene::place::Placement;
use crate::scene::surfaces::Surface;
use crate::scene::{Model, Part, Relief};

/// The most cells along u or v.
const MAX_SEGMENTS: u32 = 1 << 14;

impl SceneFile {
    /// # Errors
    /// What objects and materials say does not go together.
    pub(super) fn check_objects(&self) -> Result<(), Error> {
        self.check_materials()?;
        self.lights()?;
        for object in &self.file.object {
            let at = object.span();
            let object = object.get_ref();
            self.surface(object, &at)?;
            object.material.as_ref().map(|name| self.material(name)).transpose()?;
        }
        Ok(())
    }

    /// All objects as one model, and whether all have coordinates for their textures.
    pub(super) fn objects(
        &self,
        over: &Material,
        wrap: Wrap,
        warnings: &mut Warnings,
        progress: &mut dyn FnMut(u64, u64),
    ) -> Result<(Model, bool), Error> {
        let mut images = Images::new();
        let (mut all, mut has_uv) = (Model::default(), true);
        for object in &self.file.object {
            let (object, at) = (object.get_ref(), object.span());
            let material = object.material.as_ref().map(|name| self.material(name)).transpose()?;
            let mut coordinates = true;
            let mut model = match self.surface(object, &at)? {
                Some(surface) => self.surface_mesh(surface, object, material.as_ref(), over, &mut images)?,
                None => {
                    let loaded = self.model(object, progress)?;
                    loaded.warnings.each(|warning| warnings.push(warning));
                    coordinates = loaded.has_uv;
                    loaded.model
                }
            };
            images.adopt(&mut model);
            if let Some(material) = &material {
                for part in &mut model.parts {
                    let triangles = std::mem::take(&mut part.triangles);
                    let name = std::mem::take(&mut part.name);
                    *part = Part { name, triangles, diffuse: obj::DEFAULT_DIFFUSE, ..Part::default() };
                }
                if object.surface.is_none() {
                    let [su, sv] = material.uv_scale.unwrap_or([1.0; 2]);
                    model.vertices.iter_mut().for_each(|v| v.uv = [v.uv[0] * su, v.uv[1] * sv]);
                }
                prepare::replace_materials(&mut model, material, &mut images)?;
            }
            prepare::replace_materials(&mut model, over, &mut images)?;
            has_uv &= coordinates || !model.parts.iter().any(Part::has_maps);
            prepare::complete(&mut model, &images, wrap, warnings);
            placement(object).apply(&mut model);
            append(&mut all, model, || self.source.error(&at, "more than 4 billion vertices", "fewer"))?;
        }
        images.give(&mut all);
        Ok((all, has_uv))
    }

    /// The surface that an object is, if it is no model.
    fn surface(&self, object: &tables::Object, at: &Range<usize>) -> Result<Option<Surface>, Error> {
        let kind = object.surface.as_ref().map(|kind| super::named(kind.get_ref()));
        let is = |kinds: &[SurfaceKind]| kind.is_some_and(|kind| kinds.contains(&kind));
        match (&object.model, &object.surface) {
            (Some(_), Some(surface)) => {
                return Err(self.source.error(&surface.span(), "a model as well", "one of both"));
            }
            (None, None) => {
                return Err(self.source.error(at, "an object without model and surface", "one of both"));
            }
            _ => {}
        }
        self.only(&object.segments, kind.is_some(), "a surface")?;
        self.only(&object.size, is(&[SurfaceKind::Plane]), "a plane")?;
        let round = [SurfaceKind::Sphere, SurfaceKind::Cylinder];
        self.only(&object.radius, is(&round), "a sphere or a cylinder")?;
        self.only(&object.radii, is(&[SurfaceKind::Torus]), "a torus")?;
        self.only(&object.height, is(&[SurfaceKind::Cylinder]), "a cylinder")?;
        let radius = object.radius.as_ref().map_or(1.0, |radius| radius.get_ref().0);
        let height = object.height.as_ref().map_or(2.0, |height| height.get_ref().0);
        Ok(kind.map(|kind| match kind {
            SurfaceKind::Plane => {
                Surface::Plane { size: object.size.as_ref().map_or([2.0; 2], |size| size.get_ref().0) }
            }
            SurfaceKind::Sphere => Surface::Sphere { radius },
            SurfaceKind::Cylinder => Surface::Cylinder { radius, height },
            SurfaceKind::Torus => {
                let [major, minor] = object.radii.as_ref().map_or([1.0, 0.35], |radii| radii.get_ref().0);
                Surface::Torus { major, minor }
            }
        }))
    }

    /// A surface's mesh; as fine as the heights are by which it is displaced.
    fn surface_mesh(
        &self,
        surface: Surface,
        object: &tables::Object,
        material: Option<&Material>,
        over: &Material,
        images: &mut Images,
    ) -> Result<Model, Error> {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole and in range")]
        let given = object.segments.as_ref().map(|n| n.get_ref().0.map(|x| x as u32));
        let mut segments = given.unwrap_or(surface.segments());
        if let (Some(n), true) = (&object.segments, cells(segments) > MAX_VERTICES) {
            let found = format!("{} cells", cells(segments));
            return Err(self.source.error(&n.span(), found, format!("at most {MAX_VERTICES}")));
        }
        let uv_scale = material.and_then(|m| m.uv_scale).unwrap_or([1.0; 2]);
        let said = || [Some(over), material].into_iter().flatten();
        if let Some(map) = said().find_map(|m| m.height_map.as_ref())
            && said().find_map(|m| m.relief) == Some(Relief::Displacement)
            && let Some(index) = images.heights(map)?
            && let Some(image) = images.height_image(index)
        {
            let texels = [(image.width, uv_scale[0]), (image.height, uv_scale[1])].map(|(side, scale)| {
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "saturation is wanted"
                )]
                let cells = (f64::from(side) * f64::from(scale)).ceil() as u32;
                cells.min(MAX_SEGMENTS)
            });
            let fine = [segments[0].max(texels[0]), segments[1].max(texels[1])];
            // Otherwise, what is affordable of that is found when triangles are divided.
            if cells(fine) <= MAX_VERTICES {
                segments = fine;
            }
        }
        Ok(surface.mesh(segments, uv_scale))
    }

    fn model(
        &self,
        object: &tables::Object,
        progress: &mut dyn FnMut(u64, u64),
    ) -> Result<obj::Loaded, Error> {
        let Some(name) = &object.model else { return Err(Error::new("no model", "a model")) };
        obj::load(&self.source.beside(name.get_ref()), progress).map_err(|error| {
            let found = format!("a model {} that cannot be used ({error})", quote(name.get_ref().as_bytes()));
            self.source.error(&name.span(), found, "a Wavefront OBJ model")
        })
    }
}

fn cells([columns, rows]: [u32; 2]) -> u64 {
    u64::from(columns) * u64::from(rows)
}

fn placement(object: &tables::Object) -> Placement {
    Placement {
        position: object.position.as_ref().map_or([0.0; 3], |p| p.get_ref().0.map(f64::from)),
        rotation: object.rotation.as_ref().map_or([0.0; 3], |r| r.get_ref().0.map(f64::from)),
        scale: object.scale.as_ref().map_or([1.0; 3], |s| s.get_ref().0.map(f64::from)),
    }
}

fn append(all: &mut Model, mut model: Model, too_many: impl Fn() -> Error) -> Result<(), Error> {
    let first = u32::try_from(all.vertices.len()).map_err(|_| too_many())?;
    u32::try_from(all.vertices.len() + model.vertices.len()).map_err(|_| too_many())?;
    all.vertices.append(&mut model.vertices);
    for part in &mut model.parts {
        part.triangles.iter_mut().flatten().for_each(|index| *index += first);
    }
    all.parts.append(&mut model.parts);
    Ok(())
}
