{
 "type": "CityJSON",
 "version": "2.0",
 "metadata": {
  "referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/25832"
 },
 "transform": {
  "scale": [1, 1, 1],
  "translate": [500000, 5400000, 100]
 },
 "CityObjects": {
  "house": {
   "type": "Building",
   "geometry": [
    {
     "type": "MultiSurface",
     "lod": "2",
     "boundaries": [
      [[0, 3, 2, 1]],
      [[4, 5, 6, 7]],
      [[0, 1, 5, 4]],
      [[1, 2, 6, 5]],
      [[2, 3, 7, 6]],
      [[3, 0, 4, 7]]
     ]
    }
   ]
  }
 },
 "vertices": [
  [0, 0, 0],
  [10, 0, 0],
  [10, 8, 0],
  [0, 8, 0],
  [0, 0, 6],
  [10, 0, 6],
  [10, 8, 6],
  [0, 8, 6]
 ]
}
