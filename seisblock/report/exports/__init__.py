"""Results in the formats of other programs: OpenQuake, pelicun, GeoJSON, K-NET."""
