use alberti_trade::boards::{model::*, price::*};
fn main() {
    let t = std::fs::read_to_string("/tmp/w/prices.csv").unwrap();
    let (e, s) = model(&parse(&t).unwrap());
    print!("{}", csv(&e));
    for s in s {
        println!("# {} {} {} {:.3}", s.board, s.scene, s.policy, s.ratio);
    }
}
