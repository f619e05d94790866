//! Convex cones of contact: second-order, polyhedral, orthant; and the de Saxcé map.
