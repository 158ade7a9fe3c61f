//! Traces of space whose ends are wrong though every number in them fits: what a plausible checker would let pass.

use orthoball::check::{Checker, Options, Place, Rule, Verdict, verify};
use orthoball::trace::{Reader, Record, Record3};

/// Three points of a plane and a fourth, vertex 3, all of whose cells the flood of the fifth destroys: it is no corner of the rim and yet not hidden. Then the
/// points span space, and the lost vertex is removed as if its star were empty.
const LOST: &str = r#"
{"format":"orthoball-trace","version":1,"algorithm":"regular","weighted":false,"permuted":false,"scale":0}
{"start":0}
{"vertex":[0.0,0.0,0.0]}
{"i":0,"event":"raise","id":0,"apexes":["+x","+y","+z"]}
{"vertex":[4.0,0.0,0.0]}
{"i":1,"event":"raise","id":1,"apexes":["+y","+z"]}
{"vertex":[0.0,4.0,0.0]}
{"i":2,"event":"raise","id":2,"apexes":["+z"]}
{"vertex":[1.0,1.0,0.0]}
{"i":3,"event":"insert","id":3,"first":[0,1,-1,2],"flood":"0010000"}
{"vertex":[1.0,1.25,0.0]}
{"i":4,"event":"insert","id":4,"first":[1,2,-1,3],"flood":"11101010000"}
{"vertex":[0.0,0.0,4.0]}
{"i":5,"event":"raise","id":5,"apexes":[]}
{"remove":3}
{"i":6,"event":"remove","id":3,"created":[]}
{"event":"end","counts":{"vertices":5,"hidden":0,"duplicates":0,"removed":1,"simplices":3},"mesh":"379321a45d3a9049fc23b126c0fc77b2ccb8bbfd2badbb768547f69fd38fb164","trace":"b32d36abfabbbc05d5040909f435d5e17ca638d8bedba186ec784f5d3be50e54"}
"#;

/// A lost vertex, as before, is removed at once: its old slot belongs to another star, and that is taken for its own.
const EMPTIED: &str = r#"
{"format":"orthoball-trace","version":1,"algorithm":"regular","weighted":false,"permuted":false,"scale":0}
{"start":0}
{"vertex":[0.0,0.0,0.0]}
{"i":0,"event":"raise","id":0,"apexes":["+x","+y","+z"]}
{"vertex":[1.0,2.0,4.0]}
{"i":1,"event":"raise","id":1,"apexes":["+x","+y"]}
{"vertex":[2.0,-1.0,1.0]}
{"i":2,"event":"raise","id":2,"apexes":["+x"]}
{"vertex":[0.75,0.25,1.25]}
{"i":3,"event":"insert","id":3,"first":[0,1,-1,2],"flood":"0010000"}
{"vertex":[1.0,0.125,1.375]}
{"i":4,"event":"insert","id":4,"first":[1,2,-1,3],"flood":"11101010000"}
{"remove":3}
{"i":5,"event":"remove","id":3,"created":[]}
{"vertex":[-1.0,-1.0,-1.0]}
{"i":6,"event":"raise","id":5,"apexes":[]}
{"event":"end","counts":{"vertices":1,"hidden":0,"duplicates":0,"removed":1,"simplices":1},"mesh":"67daf9d84806ecf1bc9b6155e148e071988d9c6c437b86b77a822ca1e28acfd9","trace":"9833f056f5c0805baa450d68395f59c1c5a702c5f4954ec3cc74417f8f9af2b5"}
"#;

/// A vertex with a duplicate grows heavier where it stands; its old duplicate, of the old weight, succeeds it later.
const HEAVIER: &str = r#"
{"format":"orthoball-trace","version":1,"algorithm":"regular","weighted":true,"permuted":false,"scale":0}
{"start":0}
{"vertex":[0.0,0.0,0.0]}
{"i":0,"event":"raise","id":0,"apexes":["+x","+y","+z"]}
{"vertex":[4.0,0.0,0.0]}
{"i":1,"event":"raise","id":1,"apexes":["+y","+z"]}
{"vertex":[0.0,4.0,0.0]}
{"i":2,"event":"raise","id":2,"apexes":["+z"]}
{"vertex":[0.0,0.0,4.0]}
{"i":3,"event":"raise","id":3,"apexes":[]}
{"vertex":[1.0,1.0,1.0]}
{"i":4,"event":"insert","id":4,"first":[0,1,2,3],"flood":"0000"}
{"vertex":[1.0,1.0,1.0]}
{"i":5,"event":"duplicate","id":5,"of":4}
{"weight":3.0,"id":4}
{"i":6,"event":"insert","id":4,"first":[1,2,4,3],"flood":"1101000"}
{"vertex":[1.0,1.0,0.75]}
{"i":7,"event":"hide","id":6,"cell":[0,1,2,4]}
{"remove":4}
{"i":8,"event":"succeed","id":4,"by":5}
{"event":"end","counts":{"vertices":5,"hidden":1,"duplicates":0,"removed":1,"simplices":4},"mesh":"49e087289f48e25c019fb51977aefc3e8ab92c0bcd361e5dc858ff98782c59c9","trace":"24bd327b1efeae609559dfc2bf1b5534e7c9e6261cf0988b84759f420f3f8857"}
"#;

/// A hidden point hidden beside its twin, which is taken out before the end.
const TWIN: &str = r#"
{"format":"orthoball-trace","version":1,"algorithm":"regular","weighted":true,"permuted":false,"scale":0}
{"start":0}
{"vertex":[0.0,0.0,0.0]}
{"i":0,"event":"raise","id":0,"apexes":["+x","+y","+z"]}
{"vertex":[4.0,0.0,0.0]}
{"i":1,"event":"raise","id":1,"apexes":["+y","+z"]}
{"vertex":[0.0,4.0,0.0]}
{"i":2,"event":"raise","id":2,"apexes":["+z"]}
{"vertex":[0.0,0.0,4.0]}
{"i":3,"event":"raise","id":3,"apexes":[]}
{"vertex":[1.0,1.0,1.0],"weight":3.0}
{"i":4,"event":"insert","id":4,"first":[0,1,2,3],"flood":"0000"}
{"vertex":[1.0,1.0,0.75]}
{"i":5,"event":"hide","id":5,"cell":[0,1,2,4]}
{"vertex":[1.0,1.0,0.75]}
{"i":6,"event":"hide","id":6,"cell":[0,1,2,4]}
{"remove":5}
{"i":7,"event":"remove","id":5,"created":[]}
{"event":"end","counts":{"vertices":5,"hidden":1,"duplicates":0,"removed":1,"simplices":4},"mesh":"bab535cb1bba8096db013e014fc694660f0fae3db9fc8f6f5ce2b34192c2259f","trace":"907e3513899322812963138c53fb676bccc1232de84d43f98694708768b83d58"}
"#;

#[test]
fn twins_are_refused_by_strict_verification() {
    let records: Vec<Record> = Reader::new(TWIN.trim_start().as_bytes()).collect::<Result<_, _>>().expect("a trace");
    match verify(&records, Options { strict: true, digests: true }) {
        Verdict::Rejected(r) => assert_eq!((r.event, r.rule), (Place::Event(6), Rule::Duplicate), "{r:?}"),
        other => panic!("{other:?}"),
    }
}

#[test]
fn forgeries_are_refused_where_they_go_wrong() {
    // Plainly the lost vertex is found in the orthoball of a new cell, strictly it is missed, since the neighbors of that are new.
    let lost = [Rule::Regular, Rule::Hidden];
    for (name, text, event, rules) in [
        ("a lost vertex removed later", LOST, 4, lost),
        ("a lost vertex removed at once", EMPTIED, 4, lost),
        ("an heir of another weight", HEAVIER, 6, [Rule::Order; 2]),
    ] {
        let records: Vec<Record> = Reader::new(text.trim_start().as_bytes())
            .collect::<Result<_, _>>()
            .unwrap_or_else(|e| panic!("{name}: {e}"));
        for (strict, rule) in [false, true].into_iter().zip(rules) {
            match verify(&records, Options { strict, digests: false }) {
                Verdict::Rejected(r) => assert_eq!((r.event, r.rule), (Place::Event(event), rule), "{name}: {r:?}"),
                other => panic!("{name}: {other:?}"),
            }
        }
    }
}

/// Places in the input that are none are refused, no later than at the start; whoever asks for the triangulation at any record gets one.
#[test]
fn places_in_the_input_are_each_once() {
    let header =
        r#"{"format":"orthoball-trace","version":1,"algorithm":"regular","weighted":false,"permuted":true,"scale":0}"#;
    let raise = r#"{"i":0,"event":"raise","id":0,"apexes":["+x","+y","+z"]}"#;
    let vertex = |place: u32| format!("{{\"vertex\":[{place}.0,0.0,0.0],\"input\":{place}}}");
    let refused = |lines: &[String]| {
        let text = format!("{header}\n{}\n", lines.join("\n"));
        let mut checker = Checker::new(Options { strict: false, digests: true });
        let mut records = Reader::new(text.as_bytes()).map_while(Result::ok);
        let (mut count, mut met) = (0, 0);
        let rejection = records.find_map(|record| {
            met += 1;
            count += usize::from(matches!(record, Record::Space(Record3::Vertex { .. })));
            let rejection = checker.push(&record).err().map(|r| (r.event, r.rule));
            let points = checker.triangulation().map_or(0, |t| t.points.len());
            assert_eq!(points, if rejection == Some((Place::Domain, Rule::Domain)) { count - 1 } else { count });
            rejection
        });
        (met, rejection)
    };
    let domain = Some((Place::Domain, Rule::Domain));
    let start = |places: [u32; 3]| refused(&[&places.map(vertex)[..], &[r#"{"start":0}"#.to_string()]].concat());
    assert_eq!(start([2, 0, 1]), (5, None));
    for places in [[2, 0, 2], [2, 0, 3], [u32::MAX, 0, 1]] {
        assert_eq!(start(places), (5, Some((Place::Start, Rule::Domain))), "{places:?}");
    }
    let late = |place: u32| refused(&[vertex(0), r#"{"start":0}"#.into(), raise.into(), vertex(place)]);
    assert_eq!([0, 1, 2].map(late), [(5, domain), (5, None), (5, domain)]);
}
