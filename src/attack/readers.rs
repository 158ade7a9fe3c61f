//! Readers on any bytes: they answer, with no more than the bytes can say; what was read, written and read again is the same.

use super::readers3;
use super::refinement::records;
use crate::arith::FastKernel;
use crate::check::{self, Checker, Verdict, verify};
use crate::domain::prepare;
use crate::io::{self, ForeignMesh, Format, Input, ReadError};
use crate::model::{GcdrParameters, Mesh2};
use crate::trace::{self, Reader, Record};

/// Larger graphs are read but not meshed.
const MOST_MESHED: usize = 64;

/// Files of a mesh of Triangle in one input: separated by this byte, which no text file holds.
pub(super) const BETWEEN_FILES: u8 = 0;

/// A reader of one format under attack.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Target {
    /// `.poly`, then perhaps its `.node` after a zero byte.
    Poly,
    /// `.node`, `.ele`, `.poly`, `.edge`, with zero bytes between.
    NodeEle,
    /// Well-known text.
    Wkt,
    /// GeoJSON.
    GeoJson,
    /// Object File Format.
    Off,
    /// VTK XML.
    Vtu,
    /// Gmsh.
    Msh,
    /// `.node` in space.
    Node3,
    /// `.xyz`.
    Xyz,
    /// Vertices of the Object File Format.
    Off3,
    /// Stanford polygons.
    Ply,
    /// `.csv`.
    Csv,
    /// NumPy arrays.
    Npy,
    /// `.node`, `.ele`, `.face`, `.edge` in space, with zero bytes between.
    Tetgen,
    /// Medit.
    Medit,
    /// Gmsh in space.
    Msh3,
    /// VTK XML in space.
    Vtu3,
    /// Legacy VTK.
    Vtk,
    /// Traces, JSON lines.
    TraceText,
    /// Traces, binary.
    TraceBinary,
}

/// Gives the bytes to the reader and asserts what holds of its answer.
pub fn run(target: Target, bytes: &[u8]) {
    match target {
        Target::Poly => {
            let files: Vec<&[u8]> = bytes.splitn(2, |&b| b == BETWEEN_FILES).collect();
            graph(bytes, io::parse_poly(files[0], files.get(1).copied()));
            if files.len() == 1 {
                graph(bytes, io::parse_node(bytes));
            }
        }
        Target::NodeEle => {
            let files: Vec<&[u8]> = bytes.splitn(4, |&b| b == BETWEEN_FILES).collect();
            let part = |k: usize| files.get(k).copied();
            let read = io::parse_node_ele(io::TriangleFiles {
                node: files[0],
                ele: part(1).unwrap_or_default(),
                poly: part(2),
                edge: part(3),
            });
            mesh(bytes, read);
        }
        Target::Wkt => graph(bytes, io::parse_wkt(bytes)),
        Target::GeoJson => graph(bytes, io::parse_geojson(bytes)),
        Target::Off => mesh(bytes, io::parse_off(bytes)),
        Target::Vtu => mesh(bytes, io::parse_vtu(bytes)),
        Target::Msh => mesh(bytes, io::parse_msh(bytes)),
        Target::Node3 => readers3::points(Format::Node, bytes),
        Target::Xyz => readers3::points(Format::Xyz, bytes),
        Target::Off3 => readers3::points(Format::Off, bytes),
        Target::Ply => readers3::points(Format::Ply, bytes),
        Target::Csv => readers3::points(Format::Csv, bytes),
        Target::Npy => readers3::points(Format::Npy, bytes),
        Target::Tetgen => readers3::tetgen(bytes),
        Target::Medit => readers3::mesh(Format::Medit, bytes),
        Target::Msh3 => readers3::mesh(Format::Msh, bytes),
        Target::Vtu3 => readers3::mesh(Format::Vtu, bytes),
        Target::Vtk => readers3::mesh(Format::Vtk, bytes),
        Target::TraceText | Target::TraceBinary => trace_of(bytes),
    }
}

/// A refusal is one line that says what is wrong, and in which file.
pub(super) fn assert_located(e: &ReadError) {
    assert!(!e.part.is_empty() && !e.problem.is_empty(), "{e:?}");
    assert!(!e.to_string().contains(char::is_control), "{e:?}");
}

/// Every vertex takes at least two bytes of a file, every segment one.
fn graph(bytes: &[u8], read: Result<Input, ReadError>) {
    let input = match read {
        Ok(input) => input,
        Err(e) => return assert_located(&e),
    };
    let graph = &input.pslg;
    let elements = graph.points.len() + graph.segments.len() + graph.holes.len();
    assert!(elements <= 2 * bytes.len());
    assert!(graph.attributes.len() <= bytes.len());
    assert!(graph.points.iter().all(|p| p.is_finite()));

    if graph.points.is_empty() {
        // In `.poly` this says that the vertices stand elsewhere.
        return;
    }
    // As `.poly` it comes back, but for what that format does not tell.
    let file = io::write::triangle::pslg(graph);
    let again = io::parse_poly(&file, None).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(again.pslg.points, graph.points);
    assert_eq!(again.pslg.attributes, graph.attributes);
    let ends = |g: &crate::model::Pslg| -> Vec<_> { g.segments.iter().map(|s| (s.ends, s.marker)).collect() };
    assert_eq!(ends(&again.pslg), ends(graph));
    let twice = io::write::triangle::pslg(&again.pslg);
    assert_eq!(twice.escape_ascii().to_string(), file.escape_ascii().to_string());

    if graph.points.len() + graph.segments.len() <= MOST_MESHED {
        refine(&input);
    }
}

/// A few steps with the defaults, if the graph can be meshed: the strict checker accepts them.
fn refine(input: &Input) {
    let prepared = prepare::<FastKernel>(&input.pslg, &input.lines);
    if prepared.has_errors() {
        return;
    }
    let parameters = GcdrParameters::chew(1.4);
    let Ok(trace) = records::<FastKernel>(&prepared.pslg, &parameters, 12) else {
        return;
    };
    let options = check::Options { strict: true, digests: true };
    let verdict = verify(&trace, options);
    assert!(matches!(verdict, Verdict::Accepted { .. }), "{verdict:?} of {:?}", prepared.pslg);
}

/// Written in any format, read and written again, a mesh is the same file.
fn mesh(bytes: &[u8], read: Result<ForeignMesh, ReadError>) {
    let mesh = match read {
        Ok(mesh) => mesh.into_mesh(),
        Err(e) => return assert_located(&e),
    };
    assert!(mesh.points.len() + mesh.triangles.len() + mesh.edges.len() <= 2 * bytes.len());
    assert!(mesh.attributes.len() + mesh.triangle_attributes.len() <= 2 * bytes.len());
    let count = mesh.points.len();
    assert!(mesh.triangles.iter().flatten().all(|v| v.index() < count));
    for format in [Format::Off, Format::Vtu, Format::Msh, Format::Msh2] {
        let once = written(&mesh, format);
        let again = io::read_mesh(format, &once, |_| None);
        assert_same(&mesh, format, &once, again);
    }
    let [node, ele, poly, edge] = [Format::Node, Format::Ele, Format::Poly, Format::Edge].map(|f| written(&mesh, f));
    for (format, file) in [(Format::Node, &node), (Format::Ele, &ele), (Format::Poly, &poly)] {
        let companion = |f: Format| {
            [(Format::Node, &node), (Format::Ele, &ele), (Format::Poly, &poly), (Format::Edge, &edge)]
                .iter()
                .find(|(g, _)| *g == f)
                .map(|(_, bytes)| bytes.to_vec())
        };
        assert_same(&mesh, format, file, io::read_mesh(format, file, companion));
    }
    let _ = io::write::svg(&mesh);
}

fn written(mesh: &Mesh2, format: Format) -> Vec<u8> {
    // Only graphs have formats that hold no mesh.
    io::write_mesh(mesh, format, None).expect("a format of meshes")
}

fn assert_same(mesh: &Mesh2, format: Format, once: &[u8], again: Option<Result<ForeignMesh, ReadError>>) {
    let again = match again {
        Some(Ok(again)) => again.into_mesh(),
        other => panic!("{format:?} of {mesh:?}: {other:?}"),
    };
    assert_eq!(again.points, mesh.points, "{format:?}");
    assert_eq!(again.triangles, mesh.triangles, "{format:?}");
    let twice = written(&again, format);
    assert_eq!(twice.escape_ascii().to_string(), once.escape_ascii().to_string(), "{format:?} of {mesh:?}");
}

/// What is read is canonical: written again it is the same bytes but for the digest, in the other form it reads back the same. The
/// checker takes whatever can be read.
fn trace_of(bytes: &[u8]) {
    let mut reader = Reader::new(bytes);
    let mut records: Vec<Record> = Vec::new();
    let mut checker = Checker::new(check::Options { strict: true, digests: true });
    for item in reader.by_ref() {
        let Ok(record) = item else { break };
        let _ = checker.push(&record);
        records.push(record);
    }
    let _ = checker.finish();
    let Some(Record::End(end)) = records.last() else {
        return;
    };
    // The writer puts the digest there that belongs there.
    let (claimed, digest) = (end.trace.clone(), reader.digest());
    let Some(format) = reader.format() else {
        return;
    };
    let same = super::refinement::written(&records, format);
    assert_eq!(same.len(), bytes.len());
    if claimed == digest {
        assert_eq!(same, bytes);
    }
    let other = match format {
        trace::Format::Text => trace::Format::Binary,
        trace::Format::Binary => trace::Format::Text,
    };
    let converted = super::refinement::written(&records, other);
    let back: Result<Vec<Record>, _> = Reader::new(&converted[..]).collect();
    if let Some(Record::End(end)) = records.last_mut() {
        end.trace = digest;
    }
    assert_eq!(back.unwrap_or_else(|e| panic!("{e}")), records);
}
