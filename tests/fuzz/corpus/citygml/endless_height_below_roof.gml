<?xml version="1.0" encoding="UTF-8"?>
<!-- SPDX-FileCopyrightText: The Far-LoD authors -->
<!-- SPDX-License-Identifier: Apache-2.0 -->
<CityModel xmlns="http://www.opengis.net/citygml/2.0" xmlns:g="http://www.opengis.net/gml" xmlns:b="http://www.opengis.net/citygml/building/2.0">
<cityObjectMember><b:Building g:id="a"><b:measuredHeight>inf</b:measuredHeight><b:lod0RoofEdge><g:MultiSurface><g:surfaceMember><g:Polygon><g:exterior><g:LinearRing><g:posList>0 0 9 4 0 9 4 3 9 0 0 9</g:posList></g:LinearRing></g:exterior></g:Polygon></g:surfaceMember></g:MultiSurface></b:lod0RoofEdge></b:Building></cityObjectMember>
</CityModel>
