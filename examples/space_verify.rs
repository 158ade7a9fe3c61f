use orthoball::arith::FastKernel;
use orthoball::check::{Checker, Options};
use orthoball::generators::{Draw, SplitMix64};
use orthoball::model::*;
use orthoball::refine::regular::*;
use orthoball::trace::*;
use orthoball::triangulation::regular3::Regular3;
use std::time::Instant;
fn main() {
    let n: usize = std::env::args().nth(1).unwrap().parse().unwrap();
    let kind = std::env::args().nth(2).unwrap_or("uniform".into());
    let mode = std::env::args().nth(3).unwrap_or("all".into());
    let mut d = SplitMix64(5);
    let points: Vec<Point3> = match kind.as_str() {
        "grid" => { let k = (n as f64).cbrt() as i32; let mut v = vec![]; for x in 0..k { for y in 0..k { for z in 0..k { v.push(Point3::new(x as f64, y as f64, z as f64)); } } } v }
        "sphere" => (0..n).map(|_| { loop { let p = Point3::new(d.signed_unit(), d.signed_unit(), d.signed_unit()); let l = p.length(); if l < 1.0 && l > 0.1 { return p / l; } } }).collect(),
        _ => (0..n).map(|_| Point3::new(d.unit(), d.unit(), d.unit())).collect(),
    };
    let weights = if kind == "weighted" { (0..n).map(|_| d.unit() * 0.6 * (n as f64).powf(-2.0 / 3.0)).collect() } else { vec![] };
    let set = PointSet3 { points, weights, ..Default::default() };
    let w: Vec<WeightedPoint> = orthoball::domain::normalise3(&set).unwrap().0;
    let t = Instant::now();
    let r = Regular3::<FastKernel>::build(&w, 1);
    let build = t.elapsed().as_secs_f64();
    println!("{kind} n {} cells {} build {build:.3} = {:.2} us/pt", w.len(), r.cell_count(), build * 1e6 / w.len() as f64);
    drop(r);
    for (name, c) in [("final", Certificate::Final), ("steps", Certificate::Steps)] {
        if mode != "all" && mode != name { continue; }
        let mut writer = Writer::new(Vec::new(), Format::Binary);
        let t = Instant::now();
        let tri = triangulate3::<FastKernel>(&set, c, 1, &mut writer).unwrap();
        let write = t.elapsed().as_secs_f64();
        let bytes = writer.finish().unwrap();
        println!("{name}: write {write:.3} ({:.2} x build), {} bytes, {:.1} a point", write / build, bytes.len(), bytes.len() as f64 / w.len() as f64);
        let t = Instant::now();
        let mut k = 0;
        for r in Reader::new(&bytes[..]) { r.unwrap(); k += 1; }
        println!("  read {k} records {:.3}", t.elapsed().as_secs_f64());
        for (strict, digests) in [(false, true), (false, false), (true, true)] {
            let t = Instant::now();
            let mut checker = Checker::new(Options { strict, digests });
            for r in Reader::new(&bytes[..]) { checker.push(&r.unwrap()).unwrap(); }
            let s = t.elapsed().as_secs_f64();
            println!("  verify strict {strict} digests {digests}: {s:.3} s = {:.2} x build, {:.2} us/pt", s / build, s * 1e6 / w.len() as f64);
        }
        let _ = tri;
    }
}
