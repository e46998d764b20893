//! What brakes a turning machine and heats it.

/// Losses that depend on the speed and on temperatures alone: steady moments, without motions that are quicker.
pub trait Losses {
    /// Number of losses.
    fn count(&self) -> usize;
    /// The moment of each loss against the motion, N m, at a speed in rad/s (0 or more) and at the temperatures of the
    /// nodes, °C.
    fn moments(&self, speed: f64, temperatures: &[f64], moments: &mut [f64]);
    /// Share of a loss that a node takes; what all nodes leave of it goes elsewhere (windage: with the gas).
    fn share(&self, loss: usize, node: usize) -> f64;
    /// Equal bearings that the one of a node stands for: they share what the losses heat, and the node is that of one of them.
    fn planes(&self, _node: usize) -> f64 {
        1.0
    }
}

/// Powers of the nodes, W, from those of the losses of all equal bearings.
pub(crate) fn to_nodes(losses: &impl Losses, of_losses: &[f64], nodes: usize) -> Vec<f64> {
    let of_node = |node| {
        let taken = of_losses.iter().enumerate();
        let taken = taken.map(|(loss, power)| losses.share(loss, node) * power);
        taken.sum::<f64>() / losses.planes(node)
    };
    (0..nodes).map(of_node).collect()
}

/// The moments in a list of their own.
pub fn moments(losses: &impl Losses, speed: f64, temperatures: &[f64]) -> Vec<f64> {
    let mut moments = vec![0.0; losses.count()];
    losses.moments(speed, temperatures, &mut moments);
    moments
}
