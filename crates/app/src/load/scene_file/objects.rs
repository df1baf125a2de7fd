//! Objects of a scene file: their meshes, their materials, and where they stand.

use super::SceneFile;
use super::tables::{Object, SurfaceKind};
use crate::error::{Error, Warnings, quote};
use crate::load::images::Images;
use crate::load::mtl::Alpha;
use crate::load::{obj, prepare};
use crate::options::values::{Tuple, name_of};
use crate::options::{Material, Normals, Wrap};
use crate::scene::displace::MAX_VERTICES;
use crate::scene::origin;
use crate::scene::place::Placement;
use crate::scene::surfaces::Surface;
use crate::scene::swept::Swept;
use crate::scene::{MaterialNote, Model, Part, Relief};

/// The most cells along u or v.
const MAX_SEGMENTS: u32 = 1 << 14;

/// The objects of a file with their materials, each about its own origin, and the images of them all.
#[derive(Clone, Debug)]
pub(crate) struct Gathered {
    models: Vec<Model>,
    images: Images,
    /// Whether all have coordinates for their textures.
    pub(crate) has_uv: bool,
}

impl SceneFile {
    /// # Errors
    /// Keys of an object that do not go together.
    pub(super) fn check_objects(&self) -> Result<(), Error> {
        for (object, path) in self.all() {
            self.surface(object, &path)?;
            self.material_of(object, &path)?;
        }
        Ok(())
    }

    /// The objects and their paths.
    fn all(&self) -> impl Iterator<Item = (&Object, String)> {
        self.file.object.iter().enumerate().map(|(index, object)| (object, format!("object[{index}]")))
    }

    fn material_of(&self, object: &Object, path: &str) -> Result<Option<&Material>, Error> {
        let name = object.material.as_ref();
        name.map(|name| self.material(name, &format!("{path}.material"))).transpose()
    }

    /// All objects with their materials. `over` and `normals` are what the command line says, which goes over what
    /// objects say.
    pub(super) fn objects(
        &self,
        over: &Material,
        (wrap, normals): (Wrap, Option<Normals>),
        warnings: &mut Warnings,
        progress: &mut dyn FnMut(u64, u64),
    ) -> Result<Gathered, Error> {
        let mut images = Images::new();
        let (mut models, mut has_uv) = (Vec::new(), true);
        for (object, path) in self.all() {
            let material = self.material_of(object, &path)?;
            let mut coordinates = true;
            let mut model = match self.surface(object, &path)? {
                Some(surface) => {
                    let segments =
                        self.segments(surface, object, &path, [Some(over), material], &mut images)?;
                    let mut model = surface.mesh(segments, uv_scale(material));
                    let kind = object.surface.filter(|_| object.material.is_none()).map(name_of);
                    let name = object.name.clone().or(kind).unwrap_or_default();
                    model.parts.iter_mut().for_each(|part| part.name.clone_from(&name));
                    model
                }
                None => {
                    let loaded = self.model(object, &path, normals, progress)?;
                    loaded.warnings.each(|warning| warnings.push(warning));
                    coordinates = loaded.has_uv;
                    let mut model = loaded.model;
                    let is_one = model.parts.len() == 1;
                    for (part, object) in model.parts.iter_mut().zip(std::iter::repeat(object.name.as_ref()))
                    {
                        match object {
                            Some(object) if is_one || part.name.is_empty() => part.name.clone_from(object),
                            Some(object) => part.name = format!("{object}/{}", part.name),
                            None => {}
                        }
                    }
                    model
                }
            };
            images.adopt(&mut model);
            if let Some(material) = material {
                for part in &mut model.parts {
                    let triangles = std::mem::take(&mut part.triangles);
                    let mut name = std::mem::take(&mut part.name);
                    if name.is_empty() {
                        name = object.material.clone().unwrap_or_default();
                    }
                    let material = object.material.clone().unwrap_or_default();
                    *part =
                        Part { name, material, triangles, diffuse: obj::DEFAULT_DIFFUSE, ..Part::default() };
                }
                if object.surface.is_none() {
                    let [su, sv] = uv_scale(Some(material));
                    model.vertices.iter_mut().for_each(|v| v.uv = [v.uv[0] * su, v.uv[1] * sv]);
                }
                prepare::replace_materials(&mut model, material, &mut images)?;
                let has_alpha =
                    |part: &Part| part.texture.is_some_and(|map| images.alpha(map) != Alpha::Opaque);
                if material.ignores_alpha() && model.parts.iter().any(has_alpha) {
                    warnings.push(self.unused_alpha(object.material.as_deref().unwrap_or_default()));
                }
                let name = object.material.clone().unwrap_or_default();
                model.notes.materials = vec![MaterialNote { name, maps: images.notes(material.maps()) }];
            }
            prepare::replace_materials(&mut model, over, &mut images)?;
            has_uv &= coordinates || !model.parts.iter().any(Part::has_maps);
            prepare::complete(&mut model, &mut images, wrap, warnings);
            models.push(model);
        }
        Ok(Gathered { models, images, has_uv })
    }

    /// All objects as one model.
    ///
    /// # Errors
    /// There are too many vertices.
    pub(super) fn placed(&self, Gathered { models, images, .. }: Gathered) -> Result<Model, Error> {
        let places = || self.file.object.iter().map(placement);
        let points = models.iter().zip(places()).flat_map(|(model, placement)| {
            model.vertices.iter().map(|vertex| vertex.position).map(placement.places(model, [0.0; 3]))
        });
        let mut all = Model { origin: origin::of(points), ..Model::default() };
        for ((mut model, placement), (_, path)) in models.into_iter().zip(places()).zip(self.all()) {
            placement.apply(&mut model, all.origin);
            append(&mut all, model, || self.source.error(&path, "more than 4 billion vertices", "fewer"))?;
        }
        images.give(&mut all);
        Ok(all)
    }

    /// The places that objects come to, at these moments of the file.
    pub(crate) fn swept<'a>(
        Gathered { models, .. }: &Gathered,
        moments: impl Iterator<Item = &'a Self> + Clone,
    ) -> Swept {
        let mut swept = Swept::default();
        for (index, model) in models.iter().enumerate() {
            let objects = moments.clone().filter_map(|moment| moment.file.object.get(index));
            let mut placements: Vec<_> = objects.map(placement).collect();
            placements.dedup();
            swept.add(model, &placements);
        }
        swept
    }

    /// The surface that an object is, if it is no model.
    fn surface(&self, object: &Object, path: &str) -> Result<Option<Surface>, Error> {
        let kind = object.surface;
        let key = |key: &str| format!("{path}.{key}");
        match (&object.model, kind) {
            (Some(_), Some(_)) => {
                return Err(self.source.error(&key("surface"), "a model as well", "a model or a surface"));
            }
            (None, None) => {
                return Err(self.source.error(path, "an object without model and surface", "one of these"));
            }
            _ => {}
        }
        let is = |kinds: &[SurfaceKind]| kind.is_some_and(|kind| kinds.contains(&kind));
        for (name, has, what) in [
            ("normals", kind.is_none(), "a model"),
            ("segments", kind.is_some(), "a surface"),
            ("size", is(&[SurfaceKind::Plane]), "a plane"),
            ("radius", is(&[SurfaceKind::Sphere, SurfaceKind::Cylinder]), "a sphere or a cylinder"),
            ("radii", is(&[SurfaceKind::Torus]), "a torus"),
            ("height", is(&[SurfaceKind::Cylinder]), "a cylinder"),
        ] {
            self.source.only(&key(name), has, what)?;
        }
        let radius = object.radius.map_or(1.0, f32::from);
        Ok(kind.map(|kind| match kind {
            SurfaceKind::Plane => Surface::Plane { size: object.size.map_or([2.0; 2], Into::into) },
            SurfaceKind::Sphere => Surface::Sphere { radius },
            SurfaceKind::Cylinder => {
                Surface::Cylinder { radius, height: object.height.map_or(2.0, f32::from) }
            }
            SurfaceKind::Torus => {
                let [major, minor] = object.radii.map_or([1.0, 0.35], Into::into);
                Surface::Torus { major, minor }
            }
        }))
    }

    /// The cells of a surface's mesh: as many as the heights have texels by which it is displaced. Of `materials`, the
    /// first comes before the second.
    fn segments(
        &self,
        surface: Surface,
        object: &Object,
        path: &str,
        materials: [Option<&Material>; 2],
        images: &mut Images,
    ) -> Result<[u32; 2], Error> {
        let segments = object.segments.map_or(surface.segments(), Tuple::whole);
        if cells(segments) > MAX_VERTICES {
            let found = format!("{} cells", cells(segments));
            let expected = format!("at most {MAX_VERTICES}");
            return Err(self.source.error(&format!("{path}.segments"), found, expected));
        }
        let said = || materials.into_iter().flatten();
        if let Some(map) = said().find_map(|m| m.height_map.as_ref())
            && said().find_map(|m| m.relief) == Some(Relief::Displacement)
            && let Some(index) = images.heights(map)?
            && let Some(image) = images.height_image(index)
        {
            let [su, sv] = uv_scale(materials[1]);
            let [columns, rows] = [(image.width, su), (image.height, sv)].map(|(side, scale)| {
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "saturation is wanted"
                )]
                let cells = (f64::from(side) * f64::from(scale)).ceil() as u32;
                cells.min(MAX_SEGMENTS)
            });
            let fine = [segments[0].max(columns), segments[1].max(rows)];
            // Otherwise, what is affordable of that is found when triangles are divided.
            if cells(fine) <= MAX_VERTICES {
                return Ok(fine);
            }
        }
        Ok(segments)
    }

    fn model(
        &self,
        object: &Object,
        path: &str,
        normals: Option<Normals>,
        progress: &mut dyn FnMut(u64, u64),
    ) -> Result<obj::Loaded, Error> {
        let normals = normals.or(object.normals).or(self.file.render.normals);
        let Some(name) = &object.model else { return Err(Error::new("no model", "a model")) };
        obj::load(&self.source.beside(name), normals, progress).map_err(|error| {
            // Faults of its lines are told there.
            if error.has_line() {
                return error;
            }
            let error = error.of(&format!("the model {}", quote(name.as_bytes())));
            self.source.place(error, &format!("{path}.model"))
        })
    }
}

fn uv_scale(material: Option<&Material>) -> [f32; 2] {
    material.and_then(|material| material.uv_scale).map_or([1.0; 2], Into::into)
}

fn cells([columns, rows]: [u32; 2]) -> u64 {
    u64::from(columns) * u64::from(rows)
}

fn placement(object: &Object) -> Placement {
    Placement {
        position: object.position.map_or([0.0; 3], Into::into),
        rotation: object.rotation.map_or([0.0; 3], Into::into),
        scale: object.scale.map_or([1.0; 3], Into::into),
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
    all.notes.normals += model.notes.normals;
    for note in model.notes.materials {
        if !all.notes.materials.contains(&note) {
            all.notes.materials.push(note);
        }
    }
    Ok(())
}
